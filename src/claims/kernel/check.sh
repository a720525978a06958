#!/bin/sh
# Puts every theorem to the kernel of Coq, a line a file. Exit code 1 where one is refused, 3 where there is no coqc.
cd "$(dirname "$0")" || exit 2
if ! command -v coqc > /dev/null; then
  echo "coqc is not installed: nothing was checked (Debian: apt-get install coq)" >&2
  exit 3
fi
if [ $# -eq 1 ]; then
  if timeout 300 coqc -q -R . Creepage "$1.v" > "$1.log" 2>&1; then
    echo "accepted $1"
  else
    echo "REFUSED  $1: $(tail -n 1 "$1.log")"
  fi
  exit
fi
coqc -q -R . Creepage Creepage.v || exit 1
coqc -q -R . Creepage Brackets.v || exit 1
ls ./*.v | sed 's|^\./||; s|\.v$||' | grep -v -e '^Creepage$' -e '^Brackets$' > files.txt
xargs -P "$(nproc)" -n 1 sh check.sh < files.txt > answers.txt
sort answers.txt
[ "$(grep -c '^accepted ' answers.txt)" -eq "$(wc -l < files.txt)" ]
