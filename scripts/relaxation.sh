#!/usr/bin/env bash
# The table of docs/notes/averages.md on the relaxation β of fbar-consistent: the error of u in mms-axis. Ten seconds; needs jq.
#     MPM_VERIFY=target/release/mpm-verify scripts/relaxation.sh
set -euo pipefail

program=${MPM_VERIFY:-mpm-verify}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# A row of a table: basis, level, amplitude (m).
row() {
    printf '| A = %s m, %s, %s |' "$3" "$1" "$2"
    for beta in 0 10 30 100; do
        "$program" run mms-axis --scheme "$1-fbar-consistent-flip" --level "$2" --set "amplitude=$3" \
            --set "relaxation=$beta" --out "$folder/$1-$2-$3-$beta" >/dev/null
        jq -j '.metrics.displacement_l2.value' "$folder/$1-$2-$3-$beta/record.json" | LC_ALL=C awk '{ printf " %.1e |", $1 }'
    done
    printf '\n'
}

echo '| | β = 0 | 10 | 30 | 100 |'
echo '|---|---|---|---|---|'
for basis in gimp bspline2; do
    for level in n16 n32; do
        row "$basis" "$level" 0.02
    done
done
row gimp n32 0.002
