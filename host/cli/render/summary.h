// What is said of a run at its end.
#ifndef GLINT_CLI_RENDER_SUMMARY_H
#define GLINT_CLI_RENDER_SUMMARY_H

#include "cli/render/run.h"

// Warns of what the frames' figures give cause to.
void render_summary_warn(const render_run *run, glint_warnings *warnings);

// How many frames there are, and what took how long, as the progress display is to show it.
void render_summary_say(const render_run *run);

#endif
