// Prints the warnings and the summary at the end of a run.
#ifndef GLINT_CLI_RENDER_SUMMARY_H
#define GLINT_CLI_RENDER_SUMMARY_H

#include "cli/render/run.h"

// Warns of noticeable figures of the frames, such as truncated light.
void render_summary_warn(const render_run *run, glint_warnings *warnings);

// Prints the number of frames and the times, in the mode of the progress display.
void render_summary_say(const render_run *run);

#endif
