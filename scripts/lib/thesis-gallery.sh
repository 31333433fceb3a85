# shellcheck shell=bash disable=SC2154
# The figures of docs/blending.md and of docs/gallery/thesis.md, from the models of examples/thesis/. Sourced by
# scripts/gallery; needs $root and $frep.

# Figures of docs/blending.md: PICTURE MODEL VERB OPTIONS... .
blending_figures=(
    "set-operations set-operations render --size 640x170"
    "half-planes half-planes field --size 420x350"
    "blend-to-edge-a blend-to-edge render --param system=0"
    "blend-to-edge-b blend-to-edge render --param system=1"
    "blend-to-edge-c blend-to-edge render --param system=2"
    "displacement-none displacement field --param kind=0 --size 320x270 --levels -1,-0.5,0,0.5,1,2,3,4,6 --title Union"
    "displacement-global displacement field --param kind=1 --size 320x270 --levels -1,-0.5,0,0.5,1,2,3,4,6 --title 1994"
    "displacement-bounded displacement field --size 320x270 --levels -1,-0.5,0,0.5,1,2,3,4,6 --title Bounded"
    "control-points control-points render"
    "control-points-steep control-points render --param height=1.1 --param width=0.3"
    "bounding-none bounding-solid render --param bounded=0"
    "bounding-solid bounding-solid render"
    "shape blend-shape render"
    "shape-more blend-shape render --param strength=0.5"
    "shape-asymmetric blend-shape render --param up=0.1 --param out=0.8 --param strength=0.35"
    "shape-small blend-shape render --param size=0.5"
    "shape-beside blend-shape render --param side=0.5"
    "shape-less blend-shape render --param strength=-0.15"
    "union-added three-operations render"
    "union-subtracted three-operations render --param strength=-0.16"
    "intersection-added three-operations render --param operation=2"
    "intersection-subtracted three-operations render --param operation=2 --param strength=-0.16"
    "subtraction-added three-operations render --param operation=3"
    "subtraction-subtracted three-operations render --param operation=3 --param strength=-0.16"
    "multiple-blend multiple-blend render"
    "partial-edge partial-edge render"
    "single-vertex single-vertex render"
    "blend-on-blend blend-on-blend render"
    "rounded-rim rounded-rim render"
    "thin-wall-first thin-wall render --param order=0 --section y=0"
    "thin-wall-last thin-wall render --section y=0"
    "construction-tree-plain construction-tree render --param blended=0"
    "construction-tree construction-tree render"
)

# Pictures of docs/gallery/thesis.md: PICTURE MODEL OPTIONS... .
thesis_pictures=(
    "shikki-set shikki-set --size 720x405 --zoom 1.12"
    "boundary boundary --size 640x340"
    "csg-tree csg-tree --size 480x400"
    "cell cell --size 360x320"
    "cell-graph cell --param graph=1 --size 360x320"
    "cell-face cell-face --size 320x320"
    "space-time disk-to-square --size 300x420 --azimuth 35 --elevation 12"
)

# Animations of docs/gallery/thesis.md: NAME MODEL OPTIONS... . A model A+B is made by frep morph of A and B, with the
# options before the colon.
thesis_animations=(
    "dancing-buddhas dancing-buddhas --along time=0..4 --even --frames 101 --fps 12.5 --size 320x243"
    "buddha-to-character dancing-buddhas --along time=0..1 --param step=1.6 --even --back --frames 32 --fps 12.5
     --size 320x243"
    "disk-to-square disk-to-square --along z=-10..10 --even --back --frames 30 --size 320x200"
    "ring-to-cross ring+cross : --along z=-10..10 --even --back --frames 30 --size 320x200"
    "torus-to-box torus-to-box --along t=-10..10 --even --back --frames 30 --size 320x220 --zoom 1.2 --quality draft"
    "letters-to-robot robot-letters+robot : --along t=-10..10 --even --back --frames 36 --size 320x260 --zoom 1.25
     --azimuth 16 --elevation 12 --quality draft"
    "sake-cup-to-pot ../sake-cup+../sake-pot : --along t=-10..10 --even --back
     --frames 36 --size 320x250 --zoom 1.7 --quality draft"
)

# The pieces of thesis/shikki-set: PREFIX MODEL X Y Z ANGLE.
shikki_pieces=(
    "tray tray 0 0 0 0"
    "pot sake-pot -42 34 7 0.5"
    "cup sake-cup 66 -42 7 0"
    "bowl soup-bowl 185 60 0 -0.75"
    "box tiered-box -190 112 0 0.4"
)

# row_of NAME ROWS...: the words of the row that begins with NAME, in the array `row`.
row_of() {
    local name=$1 text
    shift
    for text in "$@"; do
        read -r -d '' -a row <<<"$text" || true
        if [[ ${row[0]} == "$name" ]]; then return 0; fi
    done
    return 1
}

blending_figure() { # NAME
    local row size=()
    row_of "$1" "${blending_figures[@]}" || return 1
    if [[ " ${row[*]} " != *" --size "* ]]; then size=(--size 320x240 --quality normal); fi
    "$frep" "${row[2]}" "$root/examples/thesis/blending/${row[1]}.hf" -o "$root/docs/blending/$1.png" --quiet \
        "${size[@]}" "${row[@]:3}"
}

# report_row NAME FILE WARNED: a row of docs/gallery/thesis-report.md from a report of frep animate. The largest
# change is told as a share of the mean size.
report_row() {
    awk -v name="$1" -v warned="$3" '
        { gsub(/[",]/, "") }
        $1 == "measure:" { measure = $2 }
        $1 == "area:" || $1 == "volume:" {
            size = $2; sum += size; n++
            if (size == 0) empty++
            if (n == 1 || size < least) least = size
            if (n == 1 || size > most) most = size
        }
        $1 == "components:" { if (n == 1 || $2 < few) few = $2; if ($2 > many) many = $2 }
        $1 == "change:" { if ($2 > change) change = $2 }
        END {
            printf "| %s | %d | %s | %.4g to %.4g | %s | %.0f %% | %d | %s |\n", name, n, measure, least, most,
                (few == many ? few : few " to " many), 100*change/(sum/n), empty, (warned ? "yes" : "no")
        }' "$2"
}

# thesis_animation NAME: fails, when all is written, if a frame is empty or jumps.
thesis_animation() {
    local row model work said begin=2 morph=() report=$root/docs/gallery/thesis-report.md
    row_of "$1" "${thesis_animations[@]}" || return 1
    work=$(mktemp -d)
    model=$root/examples/thesis/${row[1]}.hf
    if [[ ${row[1]} == *+* ]]; then
        while [[ ${row[begin]} != : ]]; do morph+=("${row[begin++]}"); done
        begin=$((begin + 1))
        model=$work/morph.hf
        "$frep" morph "$root/examples/thesis/${row[1]%+*}.hf" "$root/examples/thesis/${row[1]#*+}.hf" -o "$model" \
            "${morph[@]}" --quiet
    fi
    "$frep" animate "$model" -o "$work/$1.gif" --frame-report "$work/report.json" "${row[@]:begin}" 2>"$work/said"
    said=0
    if grep '^warning: \(empty frames\|the shape jumps\)' "$work/said" >&2; then said=1; fi
    mv "$work/$1.gif" "$root/docs/gallery/thesis/$1.gif"
    { grep -v -e '^| [a-z]' "$report" || true
      { grep '^| [a-z]' "$report" | grep -v "^| $1 |" || true
        report_row "$1" "$work/report.json" "$said"; } | sort; } >"$work/report.md"
    mv "$work/report.md" "$report"
    rm -r "$work"
    [[ $said -eq 0 ]]
}

# shikki_set: examples/thesis/shikki-set.hf, put together from the five models.
shikki_set() {
    local head piece words parts=()
    head=$(cat <<'END'
--@ title    A set of lacquer ware
--@ author   the frep authors
--@ license  CC0-1.0
--@ source   after the virtual Shikki of G. Pasko's thesis, section 4.1
--@ units    mm
--@ bounds   -300 300  -160 320  -5 235
--@ param    a[1]  spread  1..1.1  default 1  "How far apart the pieces stand"
--@ material lacquer
--@ view     14 27

-- Made by scripts/gallery thesis/shikki-set from the five models of examples/, whose comments say how they are built.
-- Every object has the name of its piece before its own; at the end the pieces are put in their places.
END
    )
    for piece in "${shikki_pieces[@]}"; do
        read -r -a words <<<"$piece"
        parts+=("${words[0]} $root/examples/${words[1]}.hf ${words[*]:2}")
    done
    compose_scene "$head" "${parts[@]}" >"$root/examples/thesis/shikki-set.new"
    mv "$root/examples/thesis/shikki-set.new" "$root/examples/thesis/shikki-set.hf"
}

thesis_picture() { # NAME
    local row
    row_of "$1" "${thesis_pictures[@]}" || return 1
    if [[ $1 == shikki-set ]]; then shikki_set; fi
    "$frep" render "$root/examples/thesis/${row[1]}.hf" -o "$root/docs/gallery/thesis/$1.png" --quiet "${row[@]:2}"
}

# thesis_gallery NAME: blending, thesis, or one of them: blending/NAME, thesis/NAME.
thesis_gallery() {
    local text name kind=${1%%/*} only=""
    if [[ $1 == */* ]]; then only=${1#*/}; fi
    mkdir -p "$root/docs/blending" "$root/docs/gallery/thesis"
    local -a rows=("${blending_figures[@]}")
    if [[ $kind == thesis ]]; then rows=("${thesis_pictures[@]}" "${thesis_animations[@]}"); fi
    local found=no
    for text in "${rows[@]}"; do
        read -r name _ <<<"$text"
        [[ -z $only || $only == "$name" ]] || continue
        found=yes
        if [[ $kind == blending ]]; then
            blending_figure "$name"
        else
            thesis_picture "$name" || thesis_animation "$name"
        fi
        echo "$kind/$name"
    done
    if [[ $found == no ]]; then
        echo "scripts/gallery: there is no picture $1" >&2
        return 1
    fi
}
