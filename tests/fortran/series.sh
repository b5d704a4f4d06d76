#!/usr/bin/env bash
# series.sh PROGRAM TOOL FOLDER: the in-situ example writes a .pvd that names every copy, at its time, and each copy is a
# file that VTK reads and a mesh that the library takes, with the field and the counts that the program printed.
set -u
program=$1 tool=$2 folder=$3

fail() { echo "$*"; exit 1; }

rm -rf "$folder"
mkdir -p "$folder"
"$program" 8 6 2 "$folder/front" >"$folder/said" 2>&1 || fail "the example ended with $?: $(cat "$folder/said")"

mapfile -t times < <(grep -oP '(?<=timestep=")[^"]+' "$folder/front.pvd")
mapfile -t files < <(grep -oP '(?<=file=")[^"]+' "$folder/front.pvd")
mapfile -t tets < <(grep -oP '^time .*: \K[0-9]+(?= tets)' "$folder/said")
[[ ${#times[@]} -eq 3 && ${#files[@]} -eq 3 && ${#tets[@]} -eq 3 ]] || fail "not three times: $(cat "$folder/front.pvd")"
[[ $(printf '%.2f ' "${times[@]}") == '0.04 0.08 0.12 ' ]] || fail "the times are ${times[*]}"
grep -q "</VTKFile>" "$folder/front.pvd" || fail "the .pvd does not end"

for i in 0 1 2; do
  report=$folder/$i.json
  "$tool" "$folder/${files[i]}" "$folder/again.vtu" --field concentration --on-flat error --on-overlap error \
    --report "$report" --quiet >"$folder/log" 2>&1 || fail "${files[i]}: $(cat "$folder/log")"
  grep -q "\"tets_in\": ${tets[i]}\b" "$report" || fail "${files[i]} has not ${tets[i]} tets: $(cat "$report")"
done
cmp -s "$folder/${files[0]}" "$folder/${files[2]}" && fail "the front does not move"

"$program" 8 6 0 "$folder/none" >"$folder/said" || fail "the solver alone ended with $?"
[[ -e $folder/none.pvd ]] && fail "wrote a series that was not asked for"
ln -s /dev/full "$folder/full_0000.vtu"  # a disk without room
"$program" 8 6 2 "$folder/full" >"$folder/said" 2>&1 && fail "wrote to a full disk"
grep -q "cannot write $folder/full" "$folder/said" || fail "said: $(cat "$folder/said")"
for wrong in 4,8 '3*5' 7x /; do
  "$program" "$wrong" >"$folder/said" 2>&1 && fail "took '$wrong' for a number"
done
"$program" eight >"$folder/said" 2>&1 && fail "took 'eight' for a number"
grep -q "'eight' is no number" "$folder/said" || fail "said: $(cat "$folder/said")"
echo "three copies, each read and simplified again"
