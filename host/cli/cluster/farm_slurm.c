// Writes and submits array jobs of Slurm. See farm_slurm.h.
#include "cli/cluster/farm_slurm.h"

#include "cli/common/shell_word.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

// ---- Texts within scripts ----------------------------------------------------------------------

// Writes the value of an option in an #SBATCH line. In file names, % begins a pattern and is
// doubled.
static void put_value(FILE *out, const char *value, bool is_pattern)
{
    fputc('"', out);
    for (; *value != '\0'; value++) {
        if (*value == '%' && is_pattern) {
            fputc('%', out);
        }
        fputc(*value, out);
    }
    fputc('"', out);
}

static glint_status check_text(const char *what, const char *text, const char *forbidden,
                               glint_error *error)
{
    for (; text != NULL && *text != '\0'; text++) {
        if (iscntrl((unsigned char)*text)) {
            return glint_fail(error, GLINT_USAGE,
                              "%s: a control character cannot stand in a job's script", what);
        }
        if (strchr(forbidden, *text) != NULL) {
            return glint_fail(error, GLINT_USAGE,
                              "%s: Slurm has no way to write a %c (use another name)", what, *text);
        }
    }
    return GLINT_OK;
}

// Refuses texts that a script cannot hold. Slurm parses quotes and backslashes in its own way, and
// differently in different places.
static glint_status check_texts(const farm_slurm *slurm, glint_error *error)
{
    const char *const texts[][3] = {
        {"--folder", slurm->folder, "\"\\"},
        {"the working directory", slurm->directory, "\"\\"},
        {"--name", slurm->name, "\"\\"},
        {"--time", slurm->time, "\"\\"},
        {"--partition", slurm->partition, "\"\\"},
        {"--program", slurm->program, ""},
        {"--sbatch", slurm->further, ""},
        {"--report-sbatch", slurm->report_further, ""},
    };
    glint_status status = GLINT_OK;
    for (int i = 0; status == GLINT_OK && i < slurm->argument_count; i++) {
        status = check_text("the arguments of glint render", slurm->arguments[i], "", error);
    }
    for (size_t i = 0; status == GLINT_OK && i < sizeof texts / sizeof *texts; i++) {
        status = check_text(texts[i][0], texts[i][1], texts[i][2], error);
    }
    return status;
}

// ---- The scripts -------------------------------------------------------------------------------

static void put_options(FILE *out, const farm_slurm *slurm, const char *name_suffix,
                        const char *log, const char *further)
{
    fputs("#SBATCH --job-name=", out);
    char *name = NULL;
    if (asprintf(&name, "%s%s", slurm->name, name_suffix) >= 0) {
        put_value(out, name, false);
        free(name);
    }
    fputs("\n#SBATCH --chdir=", out);
    put_value(out, slurm->directory, false);
    fputs("\n#SBATCH --output=", out);
    put_value(out, slurm->folder, true);
    fprintf(out, "/%s\n", log);
    fputs("#SBATCH --open-mode=append\n#SBATCH --requeue\n#SBATCH --nodes=1 --ntasks=1\n", out);
    if (slurm->partition != NULL) {
        fputs("#SBATCH --partition=", out);
        put_value(out, slurm->partition, false);
        fputc('\n', out);
    }
    if (further != NULL) {
        fprintf(out, "#SBATCH %s\n", further);
    }
}

static void put_part_options(FILE *out, const farm_slurm *slurm)
{
    fprintf(out, "#SBATCH --array=1-%d", slurm->parts);
    if (slurm->at_once > 0) {
        fprintf(out, "%%%d", slurm->at_once);
    }
    fputc('\n', out);
    if (slurm->cpus > 0) {
        fprintf(out, "#SBATCH --cpus-per-task=%d\n", slurm->cpus);
    }
    if (slurm->time != NULL) {
        fputs("#SBATCH --time=", out);
        put_value(out, slurm->time, false);
        fputc('\n', out);
    }
    put_options(out, slurm, "", "%A_%a.log", slurm->further);
}

// Records the attempt in a file that the report reads; see report/farm_report.h.
static const char begin_attempt[] =
    "part=${SLURM_ARRAY_TASK_ID:?}\n"
    "attempt=${SLURM_RESTART_COUNT:-0}\n"
    "account=$folder/${SLURM_ARRAY_JOB_ID}_$part\n"
    "echo \"part $part, attempt $attempt, on ${SLURMD_NODENAME:-?}\" >&2\n"
    "echo \"begin $attempt ${SLURMD_NODENAME:-?}\" >>\"$account.attempts\"\n"
    "# PoCL takes every core it sees, where Slurm counts them but binds nothing.\n"
    "cores=${SLURM_CPUS_PER_TASK:-${SLURM_CPUS_ON_NODE:-}}\n"
    "[ -z \"$cores\" ] || export POCL_MAX_PTHREAD_COUNT=\"$cores\"\n"
    "# Slurm tells the shell and glint to stop; the shell waits until glint has.\n"
    "stopped=\n"
    "trap 'stopped=yes' TERM INT\n";

// Puts the part back into the queue if it was killed, lost its device, ran out of memory or did not
// find the program. Another node or another time may succeed. A part that was told to stop stays
// ended. Wrong usage, bad input, full disks and bad frames also end the part: they fail on every
// node.
static const char end_attempt[] =
    "echo \"end $attempt $status\" >>\"$account.attempts\"\n"
    "[ -z \"$stopped\" ] || exit \"$status\"\n"
    "case $status in\n"
    "130 | 143) ;; # told to stop\n"
    "4 | 8 | 12[6-9] | 13[0-9] | 14[0-9] | 15[0-9])\n"
    "    if [ \"$(grep -c '^retry' \"$account.attempts\")\" -lt \"$retries\" ]; then\n"
    "        echo \"part $part ended with status $status: it goes back into the queue\" >&2\n"
    "        echo \"retry $attempt\" >>\"$account.attempts\"\n"
    "        scontrol requeue \"${SLURM_ARRAY_JOB_ID}_$part\"\n"
    "    fi\n"
    "    ;;\n"
    "esac\n"
    "exit \"$status\"\n";

static void put_part_body(FILE *out, const farm_slurm *slurm)
{
    fputs("folder=", out);
    glint_put_shell_word(slurm->folder, out);
    fprintf(out, "\nretries=%d\n%sstatus=143\n[ -n \"$stopped\" ] || {\n    ", slurm->retries,
            begin_attempt);
    glint_put_shell_word(slurm->program, out);
    fprintf(out,
            " render --skip-existing --shard \"$part/%d\" \\\n"
            "        --stats \"$account.$attempt.jsonl\" \\\n       ",
            slurm->parts);
    for (int i = 0; i < slurm->argument_count; i++) {
        fputc(' ', out);
        glint_put_shell_word(slurm->arguments[i], out);
    }
    fputs("\n    status=$?\n}\n", out);
    fputs(end_attempt, out);
}

static glint_status finish(FILE *out, char **script, glint_error *error)
{
    const bool is_whole = ferror(out) == 0;
    if (fclose(out) != 0 || !is_whole) {
        free(*script);
        *script = NULL;
        return glint_fail_memory(error, "a job's script");
    }
    return GLINT_OK;
}

glint_status farm_slurm_script(const farm_slurm *slurm, char **script, glint_error *error)
{
    *script = NULL;
    glint_status status = check_texts(slurm, error);
    if (status != GLINT_OK) {
        return status;
    }
    size_t size;
    FILE *out = open_memstream(script, &size);
    if (out == NULL) {
        return glint_fail_memory(error, "a job's script");
    }
    fputs("#!/bin/sh\n# A part of a sequence, by glint " GLINT_VERSION " farm slurm.\n", out);
    put_part_options(out, slurm);
    put_part_body(out, slurm);
    return finish(out, script, error);
}

glint_status farm_slurm_report_script(const farm_slurm *slurm, const char *job, char **script,
                                      glint_error *error)
{
    *script = NULL;
    size_t size;
    FILE *out = open_memstream(script, &size);
    if (out == NULL) {
        return glint_fail_memory(error, "a job's script");
    }
    fputs("#!/bin/sh\n# What became of the sequence, by glint " GLINT_VERSION " farm slurm.\n",
          out);
    char log[96];
    snprintf(log, sizeof log, "%s_report.txt", job);
    put_options(out, slurm, "-report", log, slurm->report_further);
    fputs("exec ", out);
    glint_put_shell_word(slurm->program, out);
    fprintf(out, " farm report --job %s ", job);
    glint_put_shell_word(slurm->folder, out);
    fputc('\n', out);
    return finish(out, script, error);
}

// ---- Handing in --------------------------------------------------------------------------------

// Unsets environment variables that override the script's options. Also unsets the variables of an
// enclosing job: a job submitted from there is no further attempt of it.
static void clear_environment(const farm_slurm *slurm)
{
    static const char *const names[] = {
        "SBATCH_ARRAY_INX",   "SBATCH_ERROR",        "SBATCH_JOB_NAME",     "SBATCH_NO_REQUEUE",
        "SBATCH_OPEN_MODE",   "SBATCH_OUTPUT",       "SBATCH_REQUEUE",      "SBATCH_WAIT",
        "SLURM_ARRAY_JOB_ID", "SLURM_ARRAY_TASK_ID", "SLURM_CPUS_PER_TASK", "SLURM_CPUS_ON_NODE",
        "SLURM_RESTART_COUNT"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        unsetenv(names[i]);
    }
    if (slurm->partition != NULL) {
        unsetenv("SBATCH_PARTITION");
    }
    if (slurm->time != NULL) {
        unsetenv("SBATCH_TIMELIMIT");
    }
}

// Runs a program and stores the beginning of its stdout in `output`. Returns its exit status, −1 on
// failure (*cause is errno if it did not start), or −2 if SIGINT or SIGTERM stopped it.
static int run_program(char *const *words, char *output, size_t capacity, int *cause)
{
    int ends[2];
    output[0] = '\0';
    if (pipe2(ends, O_CLOEXEC) != 0) {
        *cause = errno;
        return -1;
    }
    // Start the program with its stdout in the pipe.
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawnattr_t attributes; // unblocks all signals, so that Ctrl-C also ends the program
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    pid_t process;
    *cause = posix_spawnp(&process, words[0], &actions, &attributes, words, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    close(ends[1]);
    // Read stdout to its end, then wait for the exit.
    int how = -1;
    if (*cause == 0) {
        size_t length = 0;
        char rest[256];
        ssize_t got;
        do {
            const bool fits = length + 1 < capacity;
            got = fits ? read(ends[0], output + length, capacity - 1 - length)
                       : read(ends[0], rest, sizeof rest);
            length += fits && got > 0 ? (size_t)got : 0;
        } while (got > 0 || (got < 0 && errno == EINTR));
        output[length] = '\0';
        while (waitpid(process, &how, 0) < 0 && errno == EINTR) {
        }
    }
    close(ends[0]);
    if (*cause != 0) {
        return -1;
    }
    const bool stopped = WIFSIGNALED(how) && (WTERMSIG(how) == SIGINT || WTERMSIG(how) == SIGTERM);
    return WIFEXITED(how) ? WEXITSTATUS(how) : stopped ? -2 : -1;
}

glint_status farm_slurm_submit(const farm_slurm *slurm, const farm_submission *submission,
                               char id[FARM_ID_CAPACITY], glint_error *error)
{
    const char *path = submission->path, *after = submission->after;
    char dependency[96];
    snprintf(dependency, sizeof dependency, "--dependency=afterany:%s", after != NULL ? after : "");
    // Call sbatch.
    char *words[6] = {"sbatch", "--parsable"};
    int count = 2;
    if (after != NULL) {
        words[count++] = dependency;
    }
    if (submission->wait) {
        words[count++] = "--wait";
    }
    words[count] = (char *)path;
    clear_environment(slurm);
    int cause = 0;
    const int status = run_program(words, id, FARM_ID_CAPACITY, &cause);
    id[strcspn(id, ";\r\n")] = '\0'; // sbatch may append the cluster's name
    // Judge its result.
    if (cause != 0) {
        return glint_fail(error, GLINT_DEVICE_FAILED,
                          "sbatch: %s (install Slurm's client, or see the script with --dry-run)",
                          strerror(cause));
    }
    if (status == -2) {
        return glint_fail(error, GLINT_INTERRUPTED, "sbatch was stopped");
    }
    if (id[0] == '\0' || strspn(id, "0123456789") != strlen(id)) {
        return glint_fail(error, GLINT_DEVICE_FAILED,
                          "%s: sbatch did not take it (its own words stand above)", path);
    }
    return status == 0
               ? GLINT_OK
               : glint_fail(error, submission->wait ? GLINT_FRAMES_FAILED : GLINT_DEVICE_FAILED,
                            "%s: sbatch ended with status %d", path, status);
}
