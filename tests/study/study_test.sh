#!/bin/sh
# tyndall study as a user meets it. One case a function, named by the first argument;
# study_test.sh CASE PROGRAM SCENES
set -eu
case_name=$1
program=$2
scenes=$3
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
. "$here/../support/command.sh"

spent() { grep '"spent_seconds"' "$1"; } # of each technique
measured() { spent "$1/results.json" | wc -l; }

small="--size 16x16 --quiet --seed 3"

# browse PAGE?QUERY: opens a page in headless Chromium; its document is in the file dom, and what it
# prints in the file console.
browse() {
  chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking \
    --disable-component-update --disable-sync --user-data-dir="$folder/profile" --window-size=1400,1000 \
    --allow-file-access-from-files --enable-logging=stderr --v=0 \
    --dump-dom "file://$folder/$1" >dom 2>console || fail "the browser does not open $1"
}

is_quiet() { ! grep -q CONSOLE console; }

report() {
  expect 0 study "$scenes/slab.pbrt" -o a $small --budget 20 --technique volpath --technique 'orders-[12]' \
    --technique without-scattering
  exists a/results.json
  exists a/results.csv
  exists a/report.html
  [ "$(ls a | tr '\n' ' ')" = "images report.html results.csv results.json " ] || fail "folder holds: $(ls a)"
  # Points: rows as long as the head, samples that double, seconds that grow, values in their intervals.
  awk -F, 'NR == 1 { columns = NF; next }
    NF != columns { print "columns: " $0 }
    $1 == name && ($4 != 2 * samples || $5 <= seconds) { print "not after the one before: " $0 }
    $1 != name && $4 != 1 { print "does not begin with 1: " $0 }
    $7 < $8 || $7 > $9 || $10 < $11 || $10 > $12 || $13 < $14 || $13 > $15 { print "interval: " $0 }
    { name = $1; samples = $4; seconds = $5; ++rows }
    END { if (rows < 4) print "too few rows" }' a/results.csv >out
  [ ! -s out ] || fail "results.csv"
  for name in volpath orders-1 orders-2 without-scattering; do
    grep -q "^$name," a/results.csv || fail "results.csv without $name"
    grep -q "\"name\": \"$name\"" a/results.json || fail "results.json without $name"
  done
  # The page, at two widths, and as controls one with a broken image and one that is too wide.
  ! grep -qE '(src|href)="[^#d]|url\((.?)http|@import' a/report.html || fail "the report asks for something else"
  cp a/report.html report.html
  sed 's/base64,iVBOR/base64,AAAAA/' report.html >broken.html
  sed 's/<h2>/<h2 style="width:120em">/' report.html >wide.html
  sed 's/id="/id="x/; s/ class="plot"/ class="plot" hidden/' report.html >hidden.html
  cp "$here/look.html" .
  browse 'look.html?report.html@1280,report.html@400,broken.html@1280,wide.html@400,hidden.html@1280'
  cp dom out
  grep -q '^end$' dom || fail "the page was not looked at"
  is_quiet || fail "the console of the browser has messages"
  for width in 1280 400; do says "report.html $width: good ("; done
  says 'broken.html 1280: broken image'
  says 'wide.html 400: scrolls sideways'
  says 'hidden.html 1280: a plot is not shown'
  grep -q 'report.html 400: good (.* [1-9] plots)' dom || fail "no plots"
  # Control: a message in the console would have been seen.
  sed 's|</main>|</main><script>missing()</script>|' report.html >noisy.html
  browse noisy.html
  ! is_quiet || fail "an error in the console is not noticed"
}

resume() {
  "$program" study "$scenes/slab.pbrt" -o a --size 16x16 --budget 24 >out 2>err &
  process=$!
  until [ -s a/results.json ] && [ "$(measured a)" -ge 1 ]; do
    kill -0 $process || fail "ended by itself"
    sleep 0.1
  done
  kill -INT $process
  got=0
  wait $process || got=$?
  [ $got = 130 ] || fail "status $got, not 130"
  exists a/report.html
  grep -q 'ended before all' a/report.html || fail "the report does not say that it is not complete"
  before=$(measured a)
  cp a/results.json before.json
  # What is there is not measured again; without gnuplot there are results, and a message.
  PATH=/nowhere expect 1 study "$scenes/slab.pbrt" -o a --size 16x16 --budget 5 --quiet --technique volpath
  says gnuplot-nox
  [ "$(measured a)" = "$before" ] || fail "measured again"
  expect 0 study "$scenes/slab.pbrt" -o a --size 16x16 --budget 5 --quiet --technique volpath --technique orders-1
  spent before.json >before
  spent a/results.json | head -n "$(wc -l <before)" | cmp -s - before || fail "not as before"
  [ "$(grep -c '"name": "orders-1"' a/results.json)" = 1 ] || fail "orders-1 is not there once"
}

refusals() {
  expect 2 study "$scenes/slab.pbrt"
  expect 2 study "$scenes/slab.pbrt" -o a $small --technique nonsense
  says 'no technique "nonsense"'
  says orders-1
  expect 2 study "$scenes/slab.pbrt" -o a $small --budget -1
  expect 2 study "$scenes/slab.pbrt" -o a $small --device reference
  # A study of another scene is left alone.
  expect 0 study "$scenes/slab.pbrt" -o a $small --budget 3 --technique volpath
  expect 2 study "$scenes/furnace.pbrt" -o a $small --budget 3 --technique volpath
  says 'study of another scene'
  # A reference that fits, and one that does not.
  cp a/images/reference.exr .
  expect 0 study "$scenes/slab.pbrt" -o b $small --budget 3 --technique volpath --reference reference.exr
  grep -q 'The reference is the file reference.exr' b/report.html || fail "the report does not name the reference"
  expect 2 study "$scenes/slab.pbrt" -o c --size 8x8 --quiet --budget 3 --technique volpath --reference reference.exr
  says 'expected 8 x 8'
}

"$case_name"
