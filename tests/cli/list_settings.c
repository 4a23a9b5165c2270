// list_settings GROUP…: prints the options of groups of the settings table, one for each line, to
// test the help texts.
#include "render/settings_table.h"

#include <stdio.h>
#include <string.h>

static const char *const groups[] = {
    [GLINT_SETTINGS_OF_ENVIRONMENT] = "environment",
    [GLINT_SETTINGS_OF_SIZE] = "size",
    [GLINT_SETTINGS_OF_FRAME] = "frame",
    [GLINT_SETTINGS_OF_DEVICE] = "device",
    [GLINT_SETTINGS_OF_LAYERS] = "layers",
};

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        size_t group = GLINT_SETTINGS_OF_ENVIRONMENT;
        while (strcmp(groups[group], argv[i]) != 0) {
            if (++group == sizeof groups / sizeof *groups) {
                fprintf(stderr, "list_settings: no group %s\n", argv[i]);
                return 2;
            }
        }
        glint_option option;
        char text[GLINT_SETTING_TEXT];
        for (size_t row = 0;
             glint_settings_option((glint_settings_group)group, row, 0, &option, text); row++) {
            printf("%s\n", option.name);
        }
    }
    return 0;
}
