// The subcommands of glint: main.c chooses one of them by its name.
#ifndef GLINT_CLI_COMMANDS_H
#define GLINT_CLI_COMMANDS_H

#include "cli/common/options.h"

extern const glint_command glint_command_render;
extern const glint_command glint_command_info;
extern const glint_command glint_command_devices;
extern const glint_command glint_command_warm;
extern const glint_command glint_command_bench;
extern const glint_command glint_command_compare;
extern const glint_command glint_command_contact;
extern const glint_command glint_command_env;
extern const glint_command glint_command_capture;
extern const glint_command glint_command_relight;
extern const glint_command glint_command_farm;
extern const glint_command glint_command_selftest;

#endif
