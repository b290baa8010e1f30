#!/bin/sh
# Cuts the fonts of pictures down to the characters that pictures can hold: subset_fonts.sh FOLDER, which holds the
# fonts of the DejaVu release (https://dejavu-fonts.github.io). Needs pyftsubset of `pip install fonttools`.
set -eu
characters=U+0020-007E,U+00A0-00FF,U+0302,U+0304,U+0370-03FF,U+1D40,U+1D62,U+2009,U+2010-2027,U+202F,U+2032-2033
characters=$characters,U+2070-208E,U+2190-2193,U+2202,U+2206,U+2207,U+2211-2212,U+221A,U+221D,U+221E,U+222B,U+2248
characters=$characters,U+2260,U+2264-2265,U+2297
for font in DejaVuSans DejaVuSans-Bold; do
    pyftsubset "$1/$font.ttf" --unicodes="$characters" --no-hinting --layout-features= --no-glyph-names \
        --name-IDs=0,1,2,13,14 --output-file="$(dirname "$0")/../mpm-verify/assets/fonts/$font.ttf"
done
