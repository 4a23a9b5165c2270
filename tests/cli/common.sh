# shellcheck shell=bash
# Shared by the command-line tests: a work folder and checks. A script sources it with the program
# and json_get as its first two arguments, and ends with `finish`. Prints TAP.
set -u

glint=$(readlink -f -- "$1")
json_get=$(readlink -f -- "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/in" "$work/out"
cd "$work" || exit 1
count=0
failures=0

verdict() { # ok|"not ok" NAME [WHY]
    count=$((count + 1))
    printf '%s %d - %s\n' "$1" "$count" "$2"
    if [ "$1" != ok ]; then
        failures=$((failures + 1))
        printf '# %s\n' "${3-}"
        [ ! -s stderr ] || sed 's/^/# stderr: /' stderr
    fi
}

# check NAME COMMAND…: passes if the command succeeds.
check() {
    local name=$1
    shift
    if "$@" >check.log 2>&1; then
        verdict ok "$name"
    else
        verdict 'not ok' "$name" "$* $(head -c 300 check.log)"
    fi
}

skip() {
    count=$((count + 1))
    printf 'ok %d - %s # SKIP %s\n' "$count" "$1" "$2"
}

run() {
    "$glint" "$@" >stdout 2>stderr
    status=$?
}

# within LIMIT A B: the relative RMSE of two pictures is at most LIMIT. apart LIMIT A B: it is more.
within() {
    "$glint" compare "$2" "$3" --fail-above "relative-rmse=$1" --fail-above nan=0
}
apart() {
    "$glint" compare "$2" "$3" --fail-above "relative-rmse=$1"
    [ $? -eq 7 ]
}

# refuses STATUS TEXT ARGUMENT…: expects a mistake, with a line that contains TEXT.
refuses() {
    local wanted=$1 text=$2
    shift 2
    run "$@"
    local why=
    [ "$status" -eq "$wanted" ] || why="exit status $status instead of $wanted"
    [ "$(wc -l <stderr)" -eq 1 ] || why="$why; not one line on stderr"
    grep -q '^glint: ' stderr || why="$why; no line that begins with 'glint: '"
    grep -qF -- "$text" stderr || why="$why; '$text' is not said"
    [ ! -s stdout ] || why="$why; stdout is not empty"
    [ -z "$(ls -A out)" ] || why="$why; left behind: $(ls -A out)"
    rm -rf out/* out/.[!.]*
    if [ -z "$why" ]; then
        verdict ok "refused: glint $*"
    else
        verdict 'not ok' "refused: glint $*" "$why"
    fi
}

clean() {
    rm -rf out/* out/.[!.]*
}

same_pixels() { # A B
    "$glint" compare "$1" "$2" --fail-above max=0 --fail-above nan=0
}

begins_with() { # FILE HEX
    [ "$(od -An -tx1 -N $((${#2} / 2)) "$1" | tr -d ' \n')" = "$2" ]
}

# Lists the options of groups of the settings table (host/render/settings_table.h).
settings_of() { # GROUP…
    "$(dirname "$json_get")/list_settings" "$@"
}

# Checks that --help lists these options, and no others.
help_mentions() { # COMMAND OPTION…
    local command=$1 option
    shift
    "$glint" "$command" --help >help.txt || return 1
    "$glint" help "$command" | cmp - help.txt || return 1
    [ "$(wc -L <help.txt)" -le 100 ] || return 1
    for option in "$@"; do
        grep -qE "^ +(-., )?--$option( |$)" help.txt || { echo "--$option is not there"; return 1; }
    done
    [ "$(grep -cE '^ {2,6}(-., )?--[a-z]' help.txt)" -eq $# ]
}

stat_is() { # WANTED KEY…
    local wanted=$1 got
    shift
    got=$("$json_get" out/stats.json "$@") || return 1
    [ "$got" = "$wanted" ] || { echo "$* is $got"; return 1; }
}

stat_is_positive() { # KEY…
    local got
    got=$("$json_get" out/stats.json "$@") || return 1
    echo "$* is $got"
    awk -v value="$got" 'BEGIN { exit !(value + 0 > 0) }'
}

# Prints the plan. Succeeds if all tests passed.
finish() {
    printf '1..%d\n' "$count"
    [ "$failures" -eq 0 ] || printf '# %d failed\n' "$failures"
    [ "$failures" -eq 0 ]
}
