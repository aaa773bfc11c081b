# For tests of the command line, which read this with $program set: a folder of their own, and what they say of the
# program.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() {
  echo "FAILED: $*" >&2
  echo "--- output:" >&2
  cat out err >&2
  exit 1
}

# expect STATUS arguments...: the program exits with it; its output is in the files out and err.
expect() {
  wanted=$1
  shift
  got=0
  "$program" "$@" >out 2>err || got=$?
  [ "$got" = "$wanted" ] || fail "status $got, not $wanted: tyndall $*"
}

says() { grep -qF -- "$1" out err || fail "does not say: $1"; }
is_silent_about() { ! grep -qF -- "$1" out err || fail "says: $1"; }
exists() { [ -s "$1" ] || fail "no file $1"; }
is_absent() { [ ! -e "$1" ] || fail "there is a file $1"; }
leaves_only() { # files in the folder besides out and err; nothing half written
  [ "$(ls -A | grep -vxE 'out|err' | sort | tr '\n' ' ')" = "$*${*:+ }" ] || fail "folder holds: $(ls -A | tr '\n' ' ')"
}
