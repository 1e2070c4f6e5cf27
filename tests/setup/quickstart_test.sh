#!/usr/bin/env bash
# quickstart_test.sh SOURCE_DIR: tests the usage messages of ./quickstart, without building anything.
set -euo pipefail
quickstart=$1/quickstart
fail() { echo "FAILED: $1" >&2 && exit 1; }

cd /
help=$("$quickstart" --help) || fail "--help"
[[ $help == "usage: ./quickstart"* ]] || fail "--help prints no usage"
for words in "--nonsense" "test more" "help me"; do
  status=0
  # shellcheck disable=SC2086
  message=$("$quickstart" $words 2>&1 >/dev/null) || status=$?
  [[ $status == 2 ]] || fail "'$words' exits with $status; expected 2"
  [[ $message == "usage: ./quickstart"* ]] || fail "'$words' prints no usage on standard error"
done

# Without apt-get, it only says what to install.
empty=$(mktemp -d)
trap 'rm -rf "$empty"' EXIT
for tool in bash env dirname readlink; do ln -s "$(command -v $tool)" "$empty/$tool"; done
status=0
message=$(PATH=$empty "$quickstart" 2>&1) || status=$?
[[ $status == 1 && $message == *"needs Debian's apt-get"*libopenexr-dev* ]] || fail "without apt-get: $status: $message"
echo "quickstart explains itself"
