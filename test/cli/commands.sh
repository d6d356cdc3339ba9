# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2034
# What the tests of commands share: an empty folder that they work in, and commands that must succeed or refuse. The
# caller ends with status $failed.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failed=0

check() {  # check WHAT COMMAND...: the command must succeed
  local what=$1
  shift
  "$@" >last.out 2>last.err && return
  echo "FAILED: $what"
  cat last.out last.err
  failed=1
}

refuses() {  # refuses STATUS WORDS COMMAND...: the command must end so, and say so
  local status=$1 words=$2
  shift 2
  "$@" >last.out 2>last.err
  local got=$?
  [ $got -eq "$status" ] && grep -q -- "$words" last.out last.err && return
  echo "FAILED: expected status $status and '$words' from: $* (got $got)"
  cat last.out last.err
  failed=1
}
