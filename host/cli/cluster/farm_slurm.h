// Writes the scripts of a sequence as an array job of Slurm, and submits them.
#ifndef GLINT_CLI_CLUSTER_FARM_SLURM_H
#define GLINT_CLI_CLUSTER_FARM_SLURM_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

#define FARM_ID_CAPACITY 64

// An array job. All texts are borrowed; NULL if not requested.
typedef struct farm_slurm {
    const char *folder;     // folder of the job, absolute
    const char *directory;  // working directory of the parts, absolute
    const char *program;    // path of glint on the nodes
    const char *name;       // name of the job
    char *const *arguments; // for glint render
    int argument_count;
    int parts, at_once; // at_once 0: the cluster decides
    int cpus, retries;  // cpus 0: the cluster's default
    const char *time, *partition;
    // Further #SBATCH options of the parts and of the report.
    const char *further, *report_further;
} farm_slurm;

// Write the script of the parts and of the report, malloc'd. Errors: GLINT_USAGE (a text that a
// script cannot hold), GLINT_OUT_OF_MEMORY.
glint_status farm_slurm_script(const farm_slurm *slurm, char **script, glint_error *error);
glint_status farm_slurm_report_script(const farm_slurm *slurm, const char *job, char **script,
                                      glint_error *error);

// A script to submit.
typedef struct farm_submission {
    const char *path;
    const char *after; // start once this job has ended, with any result; NULL: start now
    bool wait;         // return only when the job has ended
} farm_submission;

// Submits the script and stores the job's number in `id`. sbatch prints its own messages to stderr.
// Unsets environment variables that would override the script's options. Errors:
// GLINT_DEVICE_FAILED if sbatch is missing or refuses the job; GLINT_FRAMES_FAILED if the awaited
// job failed; GLINT_INTERRUPTED if a signal stopped sbatch, such as Ctrl-C. sbatch may stop before
// this program has received its own signal.
glint_status farm_slurm_submit(const farm_slurm *slurm, const farm_submission *submission,
                               char id[FARM_ID_CAPACITY], glint_error *error);

#endif
