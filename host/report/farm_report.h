// What has become of a sequence whose parts a farm renders: the sum of the statistics that they
// left in the job's folder.
#ifndef GLINT_REPORT_FARM_REPORT_H
#define GLINT_REPORT_FARM_REPORT_H

#include "base/status.h"

#include <jansson.h>
#include <stdint.h>

#define GLINT_FARM_PARTS_MAX 100000

// One of the folder's jobs, as JOB.json says. Beside it each part keeps account in
// "JOB_PART.attempts", a line for each thing that happens,
//   begin ATTEMPT NODE
//   end ATTEMPT STATUS     glint's exit status, as the shell has it
//   retry ATTEMPT          it goes back into the queue
// and each attempt writes the lines of report/frame/stats.h to "JOB_PART.ATTEMPT.jsonl". Parts
// count from 1, attempts from 0; numbers of attempts may be left out.
typedef struct glint_farm_job {
    char id[64];     // the engine's number of the job, "1234"
    char *output;    // the frames' name, "out/jewel.####.exr"; owned
    uint64_t frames; // of all parts
    int parts;
} glint_farm_job;

void glint_farm_job_free(glint_farm_job *job);

// Writes the job's file, whole or not at all. Errors: GLINT_OUTPUT_FAILED.
glint_status glint_farm_job_write(const char *folder, const glint_farm_job *job,
                                  glint_error *error);

// A part, over all its attempts. A frame counts once: as rendered if any attempt rendered it, else
// as skipped if one found it there, else as failed.
typedef struct glint_farm_part {
    int number;
    int attempts;    // that began
    int status;      // the last one's exit status; −1: it goes on, or was killed with its shell
    char node[65];   // of the last one; "" where none began
    uint64_t frames; // that are its own
    uint64_t rendered, skipped, failed;
    double trace_ms, write_ms; // sums over what was rendered, again too
    uint64_t traced;           // frames in those sums
} glint_farm_part;

typedef struct glint_farm_report {
    glint_farm_job job;
    glint_farm_part *parts; // [job.parts]
    uint64_t rendered, skipped, failed, missing;
    uint64_t again; // renderings beyond a frame's first
    double trace_ms, write_ms;
    uint64_t traced;
    glint_warnings failures; // "frame 7: why" of frames that are not there, at most a few dozen
} glint_farm_report;

// Reads a job's folder, at any time; `job` is the job's number, NULL the folder's latest. Attempts
// that were killed leave lines that end early; what is whole of them counts. Errors:
// GLINT_BAD_INPUT (no folder of a job, or not readable), GLINT_OUT_OF_MEMORY. Whatever the
// outcome, it is for glint_farm_report_free.
glint_status glint_farm_report_read(const char *folder, const char *job, glint_farm_report *report,
                                    glint_error *error);
void glint_farm_report_free(glint_farm_report *report);

// The report for programs; a new reference.
json_t *glint_farm_report_json(const glint_farm_report *report);

#endif
