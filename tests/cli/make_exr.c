// make_exr FILE NAMES VALUES DATA DISPLAY [X Y VALUE]…: writes an EXR of constant channels, for the
// command-line tests. NAMES and VALUES are lists with commas, the names in alphabetical order.
// Windows are x min, y min, x max, y max. Each X Y VALUE sets all channels of one pixel. VALUEs may
// be "nan" and "inf".
#include "support/image_bytes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CHANNELS_MAX = 8 };

typedef struct flat_picture {
    float values[CHANNELS_MAX];
    char **patches; // X Y VALUE, X Y VALUE, …
    int patch_count;
} flat_picture;

static float value_at(int channel, int x, int y, void *context)
{
    const flat_picture *picture = context;
    float value = picture->values[channel];
    for (int i = 0; i < picture->patch_count; i++) {
        char **patch = picture->patches + 3 * (size_t)i;
        if (strtol(patch[0], NULL, 10) == x && strtol(patch[1], NULL, 10) == y) {
            value = strtof(patch[2], NULL);
        }
    }
    return value;
}

static void read_window(const char *text, int window[4])
{
    for (int i = 0; i < 4; i++) {
        char *end = NULL;
        window[i] = (int)strtol(text, &end, 10);
        text = *end == ',' ? end + 1 : end;
    }
}

int main(int argc, char **argv)
{
    if (argc < 6 || (argc - 6) % 3 != 0) {
        fprintf(stderr, "make_exr: FILE NAMES VALUES DATA DISPLAY [X Y VALUE]…\n");
        return 1;
    }
    const char *names[CHANNELS_MAX];
    flat_picture picture = {.patches = argv + 6, .patch_count = (argc - 6) / 3};
    exr_recipe recipe = {.names = names, .envmap = -1, .value = value_at, .context = &picture};
    const char *values = argv[3];
    for (char *name = strtok(argv[2], ","); name != NULL && recipe.channels < CHANNELS_MAX;
         name = strtok(NULL, ",")) {
        char *end = NULL;
        names[recipe.channels] = name;
        picture.values[recipe.channels++] = strtof(values, &end);
        values = *end == ',' ? end + 1 : end;
    }
    read_window(argv[4], recipe.data);
    read_window(argv[5], recipe.display);
    image_bytes file = exr_bytes(&recipe);
    FILE *out = fopen(argv[1], "wb");
    int status = out == NULL || fwrite(file.bytes, 1, file.length, out) != file.length;
    status |= out == NULL || fclose(out) != 0;
    image_bytes_free(&file);
    return status;
}
