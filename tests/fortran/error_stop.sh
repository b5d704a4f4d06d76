#!/usr/bin/env bash
# error_stop.sh PROGRAM ARGUMENT...: a failure without stat ends the program, which says why and returns no success.
set -u
said=$("$@" 2>&1)
status=$?
[[ $status -ne 0 ]] || { echo "ended with 0, and said: $said"; exit 1; }
grep -q "tetlod: .*there is no context" <<<"$said" || { echo "ended with $status, and said: $said"; exit 1; }
