#!/usr/bin/env bash
# Tests the command line of glint farm, with stand-ins for sbatch and scontrol that record their
# arguments. tests/slurm uses the real programs.
# farm_checks.sh GLINT JSON_GET SCENES
scenes=$(readlink -f -- "$3")
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

cp "$scenes/mirror_sphere.gltf" in/scene.gltf
cp "$scenes/mirror_sphere.bin" "$scenes/clockwork.gltf" "$scenes/clockwork.bin" in/
scene=in/scene.gltf
small=(--size 48x32 --progress none)
mkdir bin
cat >bin/sbatch <<'SBATCH'
#!/bin/sh
printf '%s\n' "$*" >>"$CALLS"
env | grep -E '^(SBATCH|SLURM)_' >"$CALLS.environment"
printf '4711;cluster\n'
SBATCH
cat >bin/scontrol <<'SCONTROL'
#!/bin/sh
printf 'scontrol %s\n' "$*" >>"$CALLS"
SCONTROL
chmod +x bin/*
export CALLS=$work/calls
touch "$CALLS"
real_path=$PATH
PATH=$work/bin:$PATH

# part NUMBER ATTEMPT SCRIPT: runs a part as Slurm would.
part() {
    SLURM_ARRAY_JOB_ID=4711 SLURM_ARRAY_TASK_ID=$1 SLURM_RESTART_COUNT=$2 SLURMD_NODENAME=node7 sh "$3" >part.log 2>&1
    status=$?
}

check 'farm --help tells every option' help_mentions farm parts at-once cpus time partition sbatch \
    report-sbatch retries name folder program dry-run wait json job help

# ---- mistakes -----------------------------------------------------------------------------------

refuses 2 'farm: what?' farm
refuses 2 'farm slrum' farm slrum
refuses 2 'no sequence' farm slurm --parts 3
refuses 2 'one frame alone' farm slurm -- "$scene" -o out/f.exr
refuses 2 'which frames?' farm slurm -- "$scene" -o out/f.####.exr
refuses 2 '--shard' farm slurm -- "$scene" --turntable 8 --shard 1/2 -o out/f.####.exr
refuses 2 '--shard' farm slurm -- "$scene" --turntable 8 --shard 1/1 -o out/f.####.exr
refuses 2 '--stats' farm slurm -- "$scene" --turntable 8 --stats out/s.json -o out/f.####.exr
refuses 2 'does not say how it was made' farm slurm -- "$scene" --turntable 8 -o out/f.####.hdr
refuses 2 'unknown option --turntabel' farm slurm -- "$scene" --turntabel 8 -o out/f.####.exr
refuses 2 '--help is no sequence' farm slurm -- --help
refuses 3 'in/none.gltf' farm slurm -- in/none.gltf --turntable 8 -o out/f.####.exr
refuses 5 'out/none' farm slurm -- "$scene" --turntable 8 -o out/none/none/f.####.exr
refuses 2 'a control character' farm slurm --name $'a\nb' -- "$scene" --turntable 8 -o out/f.####.exr
refuses 2 'Slurm has no way to write' farm slurm --folder 'out/a"b' -- "$scene" --turntable 8 -o out/f.####.exr
refuses 2 '--json: this is for the report' farm slurm --json - -- "$scene" --turntable 8 -o out/f.####.exr
refuses 2 'nothing to wait for' farm slurm --dry-run --wait -- "$scene" --turntable 8 -o out/f.####.exr
refuses 2 '--parts 0' farm slurm --parts 0 -- "$scene" --turntable 8 -o out/f.####.exr
refuses 5 'no/such/folder' farm slurm --folder no/such/folder -- "$scene" --turntable 8 -o out/f.####.exr
refuses 2 'the folder of one job' farm report
refuses 3 'no folder of a job' farm report in
printf '{"format": "something"}' >in/7.json
refuses 3 'not what glint farm writes' farm report in
refuses 3 'could not be read' farm report in/none
refuses 3 'it is no job of that folder' farm report in --job 8
mkfifo in/9.json
refuses 3 'no regular file' farm report in --job 9
rm in/9.json
refuses 2 '--job' farm report in --job ../7
check 'mistakes: nothing was submitted' test ! -s "$CALLS"

# ---- submitting ---------------------------------------------------------------------------------

run farm slurm --dry-run --parts 3 --at-once 2 --cpus 4 --time 1:00:00 --partition short \
    --sbatch '--gres=gpu:1 --account=film' -- "$scene" --turntable 8 -o out/f.####.exr
check 'a dry run: exit status 0' test "$status" -eq 0 -a ! -s stderr
check 'a dry run: nothing is made' test -z "$(ls -A out)" -a ! -s "$CALLS"
cp stdout script
for line in '--array=1-3%2' '--cpus-per-task=4' '--time="1:00:00"' '--partition="short"' \
    '--gres=gpu:1 --account=film' '--requeue' '--job-name="f"' "--output=\"$work/out/f.farm\"/%A_%a.log"; do
    check "a dry run: $line" grep -qFx -- "#SBATCH $line" script
done
check 'a dry run: a script of the shell' sh -n script
run farm slurm --dry-run --parts 9 -- "$scene" --turntable 8 -o out/f.####.exr
check 'no part without a frame' grep -qFx '#SBATCH --array=1-8' stdout
check 'no part without a frame: said' grep -q '^glint: --parts 9: there are 8 frames' stderr
run farm slurm --dry-run -- in/clockwork.gltf -o out/####.exr
check 'the frames of an animation' grep -qFx '#SBATCH --array=1-8' stdout
check 'frames without a name' grep -qFx '#SBATCH --job-name="frames"' stdout
PATH=$real_path
if ! command -v sbatch >/dev/null; then
    run farm slurm -- "$scene" --turntable 8 -o out/f.####.exr
    check 'without Slurm: exit status 4' test "$status" -eq 4
    check 'without Slurm: said' grep -q '^glint: sbatch: No such file' stderr
    clean
else
    skip 'without Slurm' 'it is installed'
fi
PATH=$work/bin:$PATH
printf '#!/bin/sh\necho no partition >&2\nexit 1\n' >bin/refusing
chmod +x bin/refusing
mkdir refusing && mv bin/refusing refusing/sbatch
PATH=$work/refusing:$PATH run farm slurm -- "$scene" --turntable 8 -o out/f.####.exr
check 'refused by Slurm: exit status 4' test "$status" -eq 4
check 'refused by Slurm: its words and ours' test "$(wc -l <stderr)" -eq 2
check 'refused by Slurm: no job' test -z "$(find out/f.farm -name '*.json')"
clean

# ---- the parts ----------------------------------------------------------------------------------

# A name with characters that are special to the shell and to Slurm.
odd="out/it's 5% \"odd\" \$HOME.####.exr"
SBATCH_PARTITION=debug SBATCH_NO_REQUEUE=1 SLURM_RESTART_COUNT=7 SBATCH_ACCOUNT=film \
    run farm slurm --parts 3 --partition short --folder 'out/a job' -- "$scene" --turntable 8 "${small[@]}" -o "$odd"
check 'submitted: exit status 0, the number on stdout' test "$status" -eq 0 -a "$(cat stdout)" = 4711
check 'submitted: the job, said' grep -q '^glint: job 4711: 8 frames in 3 parts' stderr
check 'submitted: what sbatch was given' test "$(cat "$CALLS")" = "--parsable $work/out/a job/job.sh
--parsable --dependency=afterany:4711 $work/out/a job/report.sh"
job="$work/out/a job/job.sh"
check 'submitted: what the environment would change is not there, the rest is' \
    test "$(cat "$CALLS.environment")" = SBATCH_ACCOUNT=film
run farm report 'out/a job'
check 'before its parts ran: exit status 6' test "$status" -eq 6
check 'before its parts ran: all are missing' grep -q '^0 of 8 frames are there, 0 failed, 8 are missing' stdout
mkdir elsewhere
touch elsewhere/out # a file in place of the folder
here=$PWD
cd elsewhere || exit 1
part 1 0 "$job"
cd "$here" || exit 1
check 'from elsewhere a part finds no folder' test "$status" -eq 5
run farm report 'out/a job'
check 'a part that found no folder: its status' grep -qE '^ +1 +[^ ]+ +1 +5 +3 +0 +0 +0 ' stdout
for k in 1 3; do
    part $k 1 "$job"
    check "part $k: exit status 0" test "$status" -eq 0
done
run farm report 'out/a job' --json report.json
check 'one part missing: exit status 6' test "$status" -eq 6
check 'one part missing: three frames' grep -q '^5 of 8 frames are there, 0 failed, 3 are missing' stdout
check 'one part missing: as JSON' test "$("$json_get" report.json missing)" -eq 3
part 2 0 "$job"
run farm report 'out/a job' --json -
cp stdout report.json
check 'all parts: exit status 0' test "$status" -eq 0 -a ! -s stderr
check 'all parts: as JSON alone' test "$("$json_get" report.json rendered)" -eq 8
check 'all parts: every frame' test "$(find out -maxdepth 1 -name '*.exr' | wc -l)" -eq 8
check 'all parts: the name is as it was given' test -s "out/it's 5% \"odd\" \$HOME.0008.exr"
part 2 1 "$job"
check 'a second attempt: exit status 0' test "$status" -eq 0
printf '{"event": "frame", "fra' >>'out/a job/4711_2.1.jsonl'
run farm report 'out/a job' --json report.json
check 'a second attempt: nothing is counted twice' test "$("$json_get" report.json rendered)" -eq 8
check 'a second attempt: nothing was rendered again' test "$("$json_get" report.json rendered_again)" -eq 0
check 'a second attempt: counted' grep -qE '^ +2 +[^ ]+ +2 +0 +3 +3 +0 +0 ' stdout
check 'the node is named' grep -qE '^ +2 +node7 ' stdout
echo 'begin 2000000000 node7' >>'out/a job/4711_1.attempts' # no attempt of ours
part 1 99 "$job"
run farm report 'out/a job' --job 4711
check 'an attempt after many that left nothing' test "$status" -eq 0
printf '#!/bin/sh\nprintf "4712\\n"\n' >refusing/sbatch
PATH=$work/refusing:$PATH run farm slurm --folder 'out/a job' -- "$scene" --turntable 2 "${small[@]}" -o out/g.##.exr
run farm report 'out/a job'
check 'a second job in the folder: its report' grep -q 'job 4712, 2 frames' stdout
run farm report 'out/a job' --job 4711
check 'a second job in the folder: the first ones report' test "$status" -eq 0
printf '#!/bin/sh\ncase $* in *depend*) exit 1 ;; esac\necho 4713\n' >refusing/sbatch
PATH=$work/refusing:$PATH run farm slurm -- "$scene" --turntable 2 "${small[@]}" -o out/g.##.exr
check 'a report that is refused: exit status 0' test "$status" -eq 0 -a "$(cat stdout)" = 4713
check 'a report that is refused: said' grep -q '^glint: warning: job 4713 goes on' stderr
clean
# Ctrl-C while glint waits for a job: all foreground processes get the signal.
printf '#!/bin/sh\ncase $* in *--wait*) touch "%s/waits"; exec sleep 60 ;; esac\necho 4714\n' "$work" \
    >refusing/sbatch
PATH=$work/refusing:$PATH setsid "$glint" farm slurm --wait -- "$scene" --turntable 2 "${small[@]}" \
    -o out/g.##.exr >stdout 2>stderr &
process=$!
for _ in {1..200}; do
    [ ! -e "$work/waits" ] || break
    sleep 0.1
done
kill -INT -- "-$process"
wait "$process"
status=$?
check 'Ctrl-C while it waits: exit status 130' test "$status" -eq 130
check 'Ctrl-C while it waits: what becomes of the job' \
    grep -q 'job 4714 goes on (scancel 4714 ends it)' stderr
check 'Ctrl-C while it waits: nobody waits any more' test -z "$(pgrep -s "$process")"
clean
mkdir "$work/out/f.0003.exr"
run farm slurm --parts 2 -- "$scene" --turntable 4 "${small[@]}" -o out/f.####.exr
part 1 0 out/f.farm/job.sh
check 'a frame fails: its part too' test "$status" -eq 6
part 2 0 out/f.farm/job.sh
run farm report out/f.farm
check 'a frame fails: exit status 6' test "$status" -eq 6
check 'a frame fails: named' grep -q '^failed: frame 3: out/f.0003.exr: ' stdout
rmdir out/f.0003.exr
part 1 1 out/f.farm/job.sh
run farm report out/f.farm
check 'a frame that failed once is there: exit status 0' test "$status" -eq 0 -a ! -s stderr
clean

# ---- parts that end badly -----------------------------------------------------------------------

# ends_with RETRIES COMMAND: runs a part with this command as its program, after this number of
# retries.
ends_with() {
    printf '#!/bin/sh\n%s\n' "$2" >program
    chmod +x program
    rm -rf out/f.farm
    mkdir out/f.farm
    run farm slurm --dry-run --program "$work/program" --parts 2 --retries 2 -- "$scene" \
        --turntable 4 -o out/f.####.exr
    cp stdout script
    : >"$CALLS"
    for retry in $(seq "$1"); do
        echo "retry $retry" >>out/f.farm/4711_2.attempts
    done
    part 2 7 script
}

# shellcheck disable=SC2016 # for the other shell
for how in 'kill -9 $$' 'kill -SEGV $$' 'exit 4' 'exit 127'; do
    ends_with 1 "$how"
    check "$how: it goes back into the queue" test "$(cat "$CALLS")" = 'scontrol requeue 4711_2'
    ends_with 2 "$how"
    check "$how: but not for ever" test ! -s "$CALLS" -a "$status" -ne 0
done
# shellcheck disable=SC2016
for how in 'kill -TERM $$' 'kill -INT $$' 'exit 143' 'exit 2' 'exit 3' 'exit 5' 'exit 6' 'exit 9' 'exit 0'; do
    ends_with 0 "$how"
    check "$how: it stays ended" test ! -s "$CALLS"
done
# shellcheck disable=SC2016
ends_with 0 'kill -TERM $PPID; exit 4'
check 'told to stop while it fails: it stays ended' test ! -s "$CALLS" -a "$status" -eq 4
# A frame that no attempt can render, by the program itself.
rm -rf out/f.farm
mkdir out/f.farm
run farm slurm --dry-run --parts 2 --retries 2 -- "$scene" --turntable 4 --size 65536x65536 -o out/f.####.exr
cp stdout script
: >"$CALLS"
part 2 0 script
check 'a frame too large for the device: exit status 9' test "$status" -eq 9
check 'a frame too large for the device: it stays ended' test ! -s "$CALLS"
check 'a frame too large for the device: one line' test "$(grep -c 'the frame needs 65536 MiB' part.log)" -eq 1
# A signal that arrives while the shell starts.
sed 's/^status=143$/kill -TERM $$\nstatus=143/' script >early
: >"$CALLS"
part 2 8 early
check 'told to stop before glint begins: it does not begin' test "$status" -eq 143 -a ! -s "$CALLS"
ends_with 0 'exit 6'
check 'its exit status is the program'"'"'s' test "$status" -eq 6

finish
