# Runs a program where nothing can be made in /dev/shm: in a mount namespace of its own, with a file system there that
# is read only. Ends with 77 (skipped) where namespaces are not to be had.
set -u
program=$1

inside='mount -t tmpfs -o ro none /dev/shm || exit 77
if touch /dev/shm/probe 2>/dev/null; then echo "/dev/shm can still be written to" >&2; exit 1; fi
exec "$0"'

for way in "unshare -m" "unshare -Urm"; do
  if $way mount -t tmpfs -o ro none /dev/shm 2>/dev/null; then
    exec $way bash -c "$inside" "$program"
  fi
done
echo "skipped: no mount namespace can be made here"
exit 77
