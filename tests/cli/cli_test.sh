#!/bin/sh
# The command line as a user meets it: exit codes, messages, files. One case a function, named by the first argument;
# cli_test.sh CASE PROGRAM SCENES
set -eu
case_name=$1
program=$2
scenes=$3
. "$(dirname -- "$0")/../support/command.sh"

small="--size 24x24 --quiet"

usage() {
  expect 2
  expect 2 render
  expect 2 render "$scenes/slab.pbrt" --no-such-option
  says --no-such-option
  expect 2 render "$scenes/slab.pbrt" --spp 0
  expect 2 render "$scenes/slab.pbrt" --size 12
  expect 2 render "$scenes/slab.pbrt" --crop 0,2,0,1
  expect 2 frobnicate
  expect 0 --help
  says render
  expect 0 --version
  leaves_only
}

bad_scenes() {
  expect 2 render missing.pbrt -o a.exr
  says missing.pbrt
  printf 'WorldBegin\nMaterial "hair"\nShape "sphere" "float radius" -1\n' >bad.pbrt
  expect 2 render bad.pbrt -o a.exr
  says 'bad.pbrt:2:1: error: material "hair" is not supported yet'
  says 'bad.pbrt:3:16: error:'
  head -c 100000 /dev/urandom >garbage.pbrt
  expect 2 render garbage.pbrt -o a.exr
  says garbage.pbrt:1:
  echo 'Include "loop.pbrt"' >loop.pbrt
  expect 2 render loop.pbrt -o a.exr
  says loop.pbrt:1:
  is_absent a.exr
}

no_device() {
  expect 3 render "$scenes/slab.pbrt" --device 'no such device' -o a.exr
  says 'no such device'
  leaves_only
  # Without any driver, it says what to install.
  VK_DRIVER_FILES=/dev/null VK_ICD_FILENAMES=/dev/null expect 3 render "$scenes/slab.pbrt" -o a.exr
  says mesa-vulkan-drivers
  leaves_only
  expect 0 devices
  says 0:
}

outputs() {
  expect 0 render "$scenes/slab.pbrt" $small --spp 4 -o a.exr -o a.png --stats a.json
  leaves_only a.exr a.json a.png
  oiiotool --info -v a.exr >out
  for attribute in samplesPerPixel tyndall:seed tyndall:scene_sha256 tyndall:device; do says $attribute; done
  says variance.R
  grep -q '"spp": 4' a.json || fail "statistics without samples"
  # What cannot be written is told, and leaves nothing behind.
  expect 2 render "$scenes/slab.pbrt" $small --spp 4 -o a.docx
  says a.docx
  expect 1 render "$scenes/slab.pbrt" $small --spp 1000000000 -o b.exr -o no/such/folder/a.exr # at once
  says no/such/folder
  leaves_only a.exr a.json a.png
  expect 2 render "$scenes/slab.pbrt" $small --spp 4 -o a.exr --stats a.exr
  says a.exr
  # A pipe's reader gets all of the picture.
  mkfifo pipe.exr
  cat pipe.exr >read.exr &
  expect 0 render "$scenes/slab.pbrt" $small --spp 2 -o pipe.exr
  wait $!
  oiiotool --info read.exr >out
  says 24
  rm pipe.exr read.exr
  # A link stays one.
  ln -s a.exr latest.exr
  expect 0 render "$scenes/slab.pbrt" $small --spp 2 -o latest.exr
  [ -L latest.exr ] || fail "the link was replaced"
  rm latest.exr
}

orders() {
  expect 2 render "$scenes/slab.pbrt" $small --spp 4 --aov orders -o a.png
  says 'only an .exr output has'
  expect 2 render "$scenes/slab.pbrt" $small --spp 4 --aov depth -o a.exr
  says --aov
  leaves_only
  expect 0 render "$scenes/slab.pbrt" $small --spp 4 --aov orders -o a.exr -o a.png
  oiiotool --info -v a.exr >out
  for word in order0.R order3.B order4+.G variance.B; do says "$word"; done
  leaves_only a.exr a.png
}

same_seed() {
  expect 0 render "$scenes/fog-room.pbrt" $small --spp 4 --seed 7 -o a.exr
  expect 0 render "$scenes/fog-room.pbrt" $small --spp 4 --seed 7 -o b.exr --slots 128 --workgroup 32 --run-length 3 --stages fused
  expect 0 render "$scenes/fog-room.pbrt" $small --spp 4 --seed 8 -o c.exr
  idiff -q -fail 0 a.exr b.exr >out 2>err || fail "same seed, other picture"
  ! idiff -q -fail 0 a.exr c.exr >out 2>err || fail "other seed, same picture" # control
}

# interrupt_at WORD ...: Ctrl-C once the program has said the word, and it ends with the status for that.
interrupt_at() {
  word=$1
  shift
  "$program" "$@" >out 2>err &
  process=$!
  until grep -q "$word" err; do
    kill -0 $process || fail "ended by itself"
    sleep 0.2
  done
  kill -INT $process
  got=0
  wait $process || got=$?
  [ $got = 130 ] || fail "status $got, not 130"
}

interrupt() {
  interrupt_at spp render "$scenes/fog-room.pbrt" --size 64x64 --spp 1000000 -o a.exr # spp: of its progress line
  leaves_only a.exr
}

calibrate() {
  XDG_CACHE_HOME=$PWD/cache
  export XDG_CACHE_HOME
  interrupt_at calibrating render "$scenes/fog-room.pbrt" --size 64x64 --spp 1000000 --calibrate -o a.exr
  says fastest
  exists a.exr
  # What was found is kept, and later renders of such scenes use it.
  sed -i 's/"slots": [0-9]*/"slots": 777/' cache/tyndall/tunings.json
  expect 0 render "$scenes/fog-room.pbrt" $small --spp 1 -o a.exr --stats a.json
  grep -q '"slots": 777' a.json || fail "does not use what was found"
  expect 0 render "$scenes/slab.pbrt" $small --spp 1 -o a.exr --stats a.json
  ! grep -q '"slots": 777' a.json || fail "uses what was found for another kind of scene" # control
  expect 2 render "$scenes/slab.pbrt" --calibrate --device reference
  says --calibrate
}

time_limit() {
  for bad in nan inf 0 -1; do expect 2 render "$scenes/slab.pbrt" $small -o a.exr --time $bad; done
  expect 0 render "$scenes/slab.pbrt" --size 32x32 --spp 100000000 --time 2 --write-interval 0.5 -o a.exr --stats a.json
  says spp
  grep -q '"stopped_by": "time"' a.json || fail "not by time"
  leaves_only a.exr a.json
}

target_error() {
  for bad in 0 -1 abc 5 200% 0.5%% ''; do
    expect 2 render "$scenes/slab.pbrt" $small -o a.exr "--target-error=$bad"
    says --target-error
  done
  leaves_only
  expect 0 render "$scenes/slab.pbrt" --size 16x16 --target-error 10% -o a.exr --stats a.json
  says '% error ('
  grep -q '"stopped_by": "target-error"' a.json || fail "stopped by something else"
  high=$(tr -d ' \n' <a.json | sed 's/.*"interval_95":\[[^,]*,\([^]]*\)\].*/\1/')
  awk "BEGIN { exit !($high < 0.1 && $high > 0.05) }" || fail "upper end $high"
  cp a.json b.json
  expect 0 render "$scenes/slab.pbrt" --size 16x16 --target-error 0.1 -o b.exr --slots 300
  idiff -q -fail 0 a.exr b.exr >out 2>err || fail "same target, other picture"
  oiiotool --info -v a.exr >out
  for word in tyndall:error tyndall:relative_rmse target-error; do says "$word"; done
  # Whichever comes first; the reference renderer has the same figures.
  expect 0 render "$scenes/slab.pbrt" --size 16x16 --target-error 1% --spp 8 -o a.exr --stats a.json
  grep -q '"stopped_by": "spp"' a.json || fail "not by samples"
  expect 0 render "$scenes/slab.pbrt" --size 8x8 --target-error 20% --device reference -o a.exr --stats a.json
  grep -q '"stopped_by": "target-error"' a.json || fail "the reference does not stop"
  # A picture without any light has no error to wait for.
  grep -v LightSource "$scenes/slab.pbrt" >dark.pbrt
  expect 0 render dark.pbrt --size 16x16 --target-error 1% -o a.exr
  says 'the image is black'
}

verify() {
  expect 0 verify "$scenes/slab.pbrt" $small --spp 512
  expect 1 verify "$scenes/slab.pbrt" $small --spp 512 --corrupt 0.01 # control
}

selftest() {
  expect 0 selftest --json
  grep -q '"passed": true' out || fail "no verdict"
  expect 1 selftest --corrupt 0.05 # control: every case must fail
  says 'FAILED'
  grep -q '^0 of [0-9]* passed' out || fail "some cases pass whatever the device gives"
}

compare() {
  expect 0 render "$scenes/chromatic.pbrt" $small --spp 64 --seed 1 -o a.exr
  expect 0 render "$scenes/chromatic.pbrt" $small --spp 64 --seed 2 -o b.exr
  expect 0 compare a.exr b.exr --json
  grep -q '^{' out || fail "no JSON"
  expect 0 compare a.exr a.exr
  says ' 0 '
  oiiotool a.exr --mulc 1.2,1.2,1.2,1,1,1 -o c.exr
  expect 0 compare c.exr a.exr
  says 1.2000
  expect 2 compare a.exr missing.exr
}

info() {
  expect 0 info "$scenes/fog-room.pbrt"
  says scattering
  expect 0 info "$scenes/fog-room.pbrt" --json
  grep -q '^{' out || fail "no JSON"
  expect 0 info "$scenes/haze.pbrt" --phase --phase-plot haze.svg
  for word in rayleigh 'mie, weight 0.5, mean cosine 0.7' Qsca; do says "$word"; done
  head -c 4 haze.svg | grep -q '<svg' || fail "no plot"
  expect 0 info "$scenes/haze.pbrt" --phase --json
  grep -q '"size_parameter"' out || fail "no size parameters"
  expect 1 info "$scenes/haze.pbrt" --phase-plot no/such/folder/haze.svg
  says no/such/folder
}

# Light that float32 cannot hold.
glare() {
  cat <<'END'
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "infinite" "rgb L" [3e38 3e38 3e38]
LightSource "infinite" "rgb L" [3e38 3e38 3e38]
END
}

health() {
  expect 0 render "$scenes/fog-room.pbrt" $small --spp 4 -o a.exr --stats a.json --strict
  is_silent_about warning
  glare >glare.pbrt
  expect 0 render glare.pbrt --quiet --spp 4 --seed 3 -o a.exr --stats b.json
  says 'warning: 256 contributions dropped that are not finite; first at pixel'
  says 'tyndall render glare.pbrt --seed 3 --replay'
  expect 1 render glare.pbrt --quiet --spp 4 -o a.exr --strict
  says '--strict: 256 nonfinite'
  for kind in nonfinite negative majorant_exceeded cosine_exceeded bad_direction event_limit weight_exceeded; do
    grep -q "\"$kind\": 0" a.json || fail "$kind is not 0"
  done
  grep -q '"nonfinite": 256' b.json || fail "not 256 in the statistics"
  oiiotool --info -v a.exr >out
  says '"nonfinite":256'
}

replay() {
  expect 0 render "$scenes/fog-room.pbrt" $small --replay 12,20,3
  for word in 'camera' 'surface' 'weight 1' 'mishaps: none' 'the same path'; do says "$word"; done
  leaves_only
  expect 0 render "$scenes/slab.pbrt" $small --device reference --replay 12,20,3
  says camera
  glare >glare.pbrt
  expect 1 render glare.pbrt --replay 0,0,0 # what float32 cannot hold, the reference can
  says 'mishaps: nonfinite'
  says 'DIFFERENT'
  for path in 24,0,0 0,24,0 0,0,-1 1,2 1,2,3,4 x; do expect 2 render "$scenes/slab.pbrt" $small --replay $path; done
}

"$case_name"
