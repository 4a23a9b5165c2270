// Parses the options that all contests share.
#ifndef GLINT_BENCH_OPTIONS_H
#define GLINT_BENCH_OPTIONS_H

#include "base/status.h"

#include <getopt.h>
#include <stdbool.h>

// Values of the shared options.
typedef struct bench_request {
    char *scenes;              // names with commas between, owned
    int width, height, rounds; // pixels; frames of each program
    const char *json;          // path of the report, NULL: none
    bool help;
} bench_request;

// Values in the table of long options; a contest's own options begin at BENCH_OWN_OPTIONS.
enum { BENCH_SCENES = 1, BENCH_ROUNDS, BENCH_SIZE, BENCH_JSON, BENCH_HELP, BENCH_OWN_OPTIONS };
#define BENCH_SHARED_OPTIONS                                                                       \
    {"scenes", required_argument, NULL, BENCH_SCENES},                                             \
        {"rounds", required_argument, NULL, BENCH_ROUNDS},                                         \
        {"size", required_argument, NULL, BENCH_SIZE},                                             \
        {"json", required_argument, NULL, BENCH_JSON},                                             \
    {                                                                                              \
        "help", no_argument, NULL, BENCH_HELP                                                      \
    }

// Takes a shared option with its value in optarg. Errors: GLINT_USAGE, also for other options.
glint_status bench_take_option(int option, bench_request *request, glint_error *error);

// The options of a program, and the function that takes them.
typedef struct bench_parser {
    const struct option *options;
    glint_status (*take)(int option, void *request, glint_error *error);
    void *request;
} bench_parser;

// Hands each option of the command line to `take`. Errors: those of `take`; GLINT_USAGE for unknown
// options.
glint_status bench_parse_options(int argc, char **argv, const bench_parser *parser,
                                 glint_error *error);

// Prints and frees the error of a failed program. Returns the exit status.
int bench_finish(const char *program, glint_status status, glint_error *error);

// Parses "1920x1088": two multiples of 16, from 16 to 16384. Errors: GLINT_USAGE.
glint_status bench_parse_size(const char *text, int *width, int *height, glint_error *error);

// Parses a number from 1 to `most`; `name` is the option without dashes. Errors: GLINT_USAGE.
glint_status bench_parse_count(const char *name, const char *text, double most, double *value,
                               glint_error *error);

// Replaces *copy, which the caller owns, by a copy of `text`. Errors: GLINT_OUT_OF_MEMORY.
glint_status bench_set_text(char **copy, const char *text, glint_error *error);

#endif
