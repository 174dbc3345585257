#!/usr/bin/env bash
# Checks the language of documents, help texts and messages: spelling (cspell, words.txt has our own words), and the
# length and openings of sentences (textlint, rules/). Needs `npm --prefix tests/docs ci`. Exit code 0: nothing found.
# Complaints about FILE.txt are about the line of that number in FILE.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
out=$root/build/prose
bin=$here/node_modules/.bin
[[ -x $bin/textlint ]] || { echo "check_prose.sh: run npm --prefix tests/docs ci first" >&2; exit 2; }

check_sentences() { # FILE...
    "$bin/textlint" --rulesdir "$here/rules" --config "$here/.textlintrc.json" --format unix "$@"
}
check_spelling() { # FILE...
    "$bin/cspell" --config "$here/cspell.json" --no-progress --no-summary --root "$out" "$@"
}

files_of() { # FOLDER... -- FIND'S TEST...: ours, as paths from the root
    local folders=()
    while [[ $1 != -- ]]; do folders+=("$1"); shift; done
    find "${folders[@]}" \( -name node_modules -o -name build -o -name dist -o -name gen -o -name '.?*' \) -prune \
        -o -type f \( "${@:2}" \) -print | sed 's|^\./||' | sort
}

cd "$root"
mapfile -t documents < <(files_of . -- -name '*.md')
mapfile -t sources < <(
    files_of server -- -name '*.cpp' -o -name '*.h'
    files_of client-web/src client-web/report -- -name '*.ts'
    files_of client-web -- -name '*.html'
)
rm -rf "$out"
mkdir -p "$out"

# The checks themselves, by what they must find.
printf 'What rests is not drawn.\n\n| a | b |\n|---|---|\n| %s | c |\n' "$(printf 'word %.0s' {1..31})" >"$out/bad.md"
printf 'This is mispelled.\n' >"$out/bad.txt"
found=$(check_sentences "$out/bad.md" || true)
if [[ $found != *'banned opening'* || $found != *'31 words'* ]] || check_spelling "$out/bad.txt" >/dev/null; then
    echo "check_prose.sh: the checks do not find known faults" >&2
    exit 2
fi
rm "$out"/bad.*

python3 "$here/messages.py" "$root" "$out" "${sources[@]}"
cp --parents "${documents[@]}" "$out"
cd "$out"
mapfile -t texts < <(find . -type f | sed 's|^\./||' | sort)
code=0
check_sentences "${texts[@]}" | sed "s|^$out/||" || code=1
check_spelling "${texts[@]}" || code=1
exit "$code"
