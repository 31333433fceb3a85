# shellcheck shell=bash
# Several models of examples/ in one scene. Sourced, not run; needs $root.

# scene_objects PREFIX FILE: the objects of a model without comments, their names behind a prefix.
scene_objects() {
    local name edits=()
    while read -r name; do
        edits+=(-e "s/\\b$name\\b/$1_$name/g")
    done < <(grep -o '^[a-z_]*(x\[' "$2" | sed 's/(x\[//')
    sed -e 's/ *--.*//' "${edits[@]}" "$2" | sed '/^$/d'
}

# scene_call PREFIX FILE X Y Z ANGLE: statements that put the model there, turned about z by so many radians.
scene_call() {
    local values count
    values=$(sed -n 's/^--@ param.* default \([^ ]*\) .*/\1/p' "$2" | paste -sd,)
    count=$(grep -c '^--@ param' "$2")
    printf '\n  p = [x[1] - a[1]*%s, x[2] - a[1]*%s, x[3] - %s];\n' "$3" "$4" "$5"
    printf '  t = hfRotate3DZ(p, %s);\n  q%s = [%s];\n' "$6" "$count" "${values//,/, }"
    printf '  c = [0, 0, 0];\n  f = %s_my_model(p, q%s, c);\n' "$1" "$count"
    printf '  if f > scene then s = [c[1], c[2], c[3]]; endif;\n  scene = max(scene, f);\n'
}

# compose_scene HEAD PARTS...: a model. HEAD: the lines of its annotations; a part: PREFIX FILE X Y Z ANGLE.
compose_scene() {
    local part words
    printf '%s\n' "$1"
    shift
    for part in "$@"; do
        read -r -a words <<<"$part"
        printf '\n-- ===== %s =====\n' "${words[1]##*/}"
        scene_objects "${words[0]}" "${words[1]}"
    done
    printf '\nmy_model(x[3], a[1], s[3])\n{\n  array p[3], c[3], q4[4], q5[5];\n  scene = -1000;\n'
    for part in "$@"; do
        read -r -a words <<<"$part"
        scene_call "${words[@]}"
    done
    printf '  my_model = scene;\n}\n'
}
