#!/usr/bin/env bash
# man_pages.sh FOLDER HEADER [TOOL]: tetlod.3 names every function of the header, tetlod.1 every option of the tool, and
# neither anything else.
set -u
folder=$1 header=$2 tool=${3:-} broken=0

# compare WHAT THERE IN-PAGE
compare() {
  [[ -n $2 ]] || { echo "found no $1"; broken=1; }
  diff <(echo "$2") <(echo "$3") >/dev/null && return
  echo "$1: < there, > in the page"
  diff <(echo "$2") <(echo "$3") | grep '^[<>]'
  broken=1
}

functions=$(tr '\n' ' ' <"$header" | grep -oE 'TETLOD_API [^(;]*tetlod_[a-z_0-9]+\(' | grep -oE 'tetlod_[a-z_0-9]+\($' |
  tr -d '(' | sort -u)
compare functions "$functions" "$(grep -oE '^\.BR tetlod_[a-z_0-9]+' "$folder/tetlod.3" | sed 's/^\.BR //' | sort -u)"
if [[ -n $tool ]]; then
  options=$("$tool" --help | grep -oE '^ +(-[a-z],)?--[a-z-]+' | grep -oE -- '--[a-z-]+' | sort -u)
  compare options "$options" \
    "$(sed -n '/^\.SH OPTIONS/,/^\.SH EXIT/p' "$folder/tetlod.1" | sed 's/\\-/-/g' | grep -oE -- '--[a-z-]+' | sort -u)"
fi
# warnings PAGE: what looks wrong to groff, at some widths of a terminal
warnings() {
  local width
  for width in 60 80 100; do
    MANWIDTH=$width man --warnings -l "$1" 2>&1 >/dev/null | grep . && broken=1
  done
}

if command -v man >/dev/null; then
  for page in "$folder"/*.[13]; do warnings "$page"; done
else
  echo "no man here: warnings are not looked for"
fi
[[ $broken -eq 0 ]] && echo "the man pages are complete"
exit $broken
