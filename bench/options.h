// Options that the contests share, and their values.
#ifndef GLINT_BENCH_OPTIONS_H
#define GLINT_BENCH_OPTIONS_H

#include "base/status.h"

#include <getopt.h>
#include <stdbool.h>

// What every contest is asked for.
typedef struct bench_request {
    char *scenes;              // names with commas between, owned
    int width, height, rounds; // pixels; frames of each
    const char *json;          // the file to write, NULL: none
    bool help;
} bench_request;

// Their entries in the table of long options; a contest's own options begin at BENCH_OWN_OPTIONS.
enum { BENCH_SCENES = 1, BENCH_ROUNDS, BENCH_SIZE, BENCH_JSON, BENCH_HELP, BENCH_OWN_OPTIONS };
#define BENCH_SHARED_OPTIONS                                                                       \
    {"scenes", required_argument, NULL, BENCH_SCENES},                                             \
        {"rounds", required_argument, NULL, BENCH_ROUNDS},                                         \
        {"size", required_argument, NULL, BENCH_SIZE},                                             \
        {"json", required_argument, NULL, BENCH_JSON},                                             \
    {                                                                                              \
        "help", no_argument, NULL, BENCH_HELP                                                      \
    }

// Takes one of these with its value in optarg. Errors: GLINT_USAGE, also for any other option.
glint_status bench_take_option(int option, bench_request *request, glint_error *error);

// A program's options, and what takes each of them.
typedef struct bench_parser {
    const struct option *options;
    glint_status (*take)(int option, void *request, glint_error *error);
    void *request;
} bench_parser;

// Hands each option of the command line to `take`. Errors: its, and GLINT_USAGE for what is no
// option.
glint_status bench_parse_options(int argc, char **argv, const bench_parser *parser,
                                 glint_error *error);

// Prints the error of a program that failed, and frees it. Returns the exit status.
int bench_finish(const char *program, glint_status status, glint_error *error);

// "1920x1088": each a multiple of 16 from 16 to 16384. Errors: GLINT_USAGE.
glint_status bench_parse_size(const char *text, int *width, int *height, glint_error *error);

// A number from 1 to `most`; `name` is the option's, without dashes. Errors: GLINT_USAGE.
glint_status bench_parse_count(const char *name, const char *text, double most, double *value,
                               glint_error *error);

// Puts a copy of `text` in place of *copy, which is owned. Errors: GLINT_OUT_OF_MEMORY.
glint_status bench_set_text(char **copy, const char *text, glint_error *error);

#endif
