// A sequence as an array job of Slurm: the scripts, and handing them in.
#ifndef GLINT_CLI_CLUSTER_FARM_SLURM_H
#define GLINT_CLI_CLUSTER_FARM_SLURM_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

#define FARM_ID_CAPACITY 64

// All texts are borrowed; NULL where nothing was asked for.
typedef struct farm_slurm {
    const char *folder;     // the job's, absolute
    const char *directory;  // in which the parts run, absolute
    const char *program;    // glint on the nodes
    const char *name;       // of the job
    char *const *arguments; // of glint render
    int argument_count;
    int parts, at_once; // at_once 0: as many as the cluster likes
    int cpus, retries;  // cpus 0: the cluster's default
    const char *time, *partition;
    // Options of sbatch as a script has them: of the parts, of the report.
    const char *further, *report_further;
} farm_slurm;

// The scripts of the parts and of the report, malloc'd. Errors: GLINT_USAGE (a text that cannot
// stand in a script), GLINT_OUT_OF_MEMORY.
glint_status farm_slurm_script(const farm_slurm *slurm, char **script, glint_error *error);
glint_status farm_slurm_report_script(const farm_slurm *slurm, const char *job, char **script,
                                      glint_error *error);

// A script to hand in.
typedef struct farm_submission {
    const char *path;
    const char *after; // a job: once its parts have ended, however they did; NULL: at once
    bool wait;         // until it has ended
} farm_submission;

// Hands the script in, as job `id`. sbatch's own messages go to stderr; variables of the
// environment that would beat the script's options are unset. Errors: GLINT_DEVICE_FAILED where
// there is no sbatch or it refuses; GLINT_FRAMES_FAILED if it was waited for and failed;
// GLINT_INTERRUPTED if a signal stopped sbatch, as a Ctrl-C does, perhaps before this program has
// seen its own.
glint_status farm_slurm_submit(const farm_slurm *slurm, const farm_submission *submission,
                               char id[FARM_ID_CAPACITY], glint_error *error);

#endif
