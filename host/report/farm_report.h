// Reports the result of a sequence rendered by a farm: sums the statistics that its parts left in
// the job's folder.
#ifndef GLINT_REPORT_FARM_REPORT_H
#define GLINT_REPORT_FARM_REPORT_H

#include "base/status.h"

#include <jansson.h>
#include <stdint.h>

#define GLINT_FARM_PARTS_MAX 100000

// A job of the folder, read from JOB.json. Next to this file, each part logs its events in
// "JOB_PART.attempts", one per line:
//   begin ATTEMPT NODE
//   end ATTEMPT STATUS     glint's exit status, as the shell reports it
//   retry ATTEMPT          the part goes back into the queue
// Each attempt writes the lines of report/frame/stats.h to "JOB_PART.ATTEMPT.jsonl". Parts count
// from 1, attempts from 0; numbers of attempts may be missing.
typedef struct glint_farm_job {
    char id[64];     // the cluster's number of the job, "1234"
    char *output;    // path of the frames, "out/jewel.####.exr"; owned
    uint64_t frames; // in all parts together
    int parts;
} glint_farm_job;

void glint_farm_job_free(glint_farm_job *job);

// Writes JOB.json, whole or not at all. Errors: GLINT_OUTPUT_FAILED.
glint_status glint_farm_job_write(const char *folder, const glint_farm_job *job,
                                  glint_error *error);

// The totals of a part over all its attempts. Each frame counts once: as rendered if any attempt
// rendered it, else as skipped if any attempt skipped it, else as failed.
typedef struct glint_farm_part {
    int number;
    int attempts; // number of attempts that began
    // exit status of the last attempt; −1: still running, or killed together with its shell
    int status;
    char node[65];   // of the last attempt; "" before the first
    uint64_t frames; // frames that belong to the part
    uint64_t rendered, skipped, failed;
    double trace_ms, write_ms; // sums over all renderings, repeated ones too
    uint64_t traced;           // number of renderings in these sums
} glint_farm_part;

// The totals of a job.
typedef struct glint_farm_report {
    glint_farm_job job;
    glint_farm_part *parts; // [job.parts]
    uint64_t rendered, skipped, failed, missing;
    uint64_t again; // renderings of frames that were rendered already
    double trace_ms, write_ms;
    uint64_t traced;
    glint_warnings failures; // "frame 7: why" for missing frames, a few dozen at most
} glint_farm_report;

// Reads a job's folder, at any time. `job` is the job's number; NULL means the latest job. Killed
// attempts may leave an incomplete last line, which is ignored. Free the report with
// glint_farm_report_free, also after an error. Errors: GLINT_BAD_INPUT (no folder of a job, or not
// readable), GLINT_OUT_OF_MEMORY.
glint_status glint_farm_report_read(const char *folder, const char *job, glint_farm_report *report,
                                    glint_error *error);
void glint_farm_report_free(glint_farm_report *report);

// The report as JSON; a new reference.
json_t *glint_farm_report_json(const glint_farm_report *report);

#endif
