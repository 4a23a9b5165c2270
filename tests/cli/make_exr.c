// make_exr FILE NAMES VALUES DATA DISPLAY [X Y VALUE]…: writes an EXR of constant channels, for the
// command-line tests. NAMES and VALUES are lists with commas, the names in alphabetical order.
// Windows are x min, y min, x max, y max. Each X Y VALUE sets all channels of one pixel. VALUEs may
// be "nan" and "inf". NAMES of several parts: "depth=Z/rgba=B,G,R".
#include "support/image_bytes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CHANNELS_MAX = 8, PARTS_MAX = 4 };

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

// Reads the names of a part, and as many values. Returns what is left of the values.
static const char *read_part(char *text, const char *values, const char **names,
                             flat_picture *picture, exr_recipe *recipe)
{
    char *equals = strchr(text, '=');
    if (equals != NULL) {
        *equals = '\0';
        recipe->part = text;
        text = equals + 1;
    }
    for (char *name; recipe->channels < CHANNELS_MAX && (name = strsep(&text, ",")) != NULL;) {
        char *end = NULL;
        names[recipe->channels] = name;
        picture->values[recipe->channels++] = strtof(values, &end);
        values = *end == ',' ? end + 1 : end;
    }
    return values;
}

int main(int argc, char **argv)
{
    if (argc < 6 || (argc - 6) % 3 != 0) {
        fprintf(stderr, "make_exr: FILE NAMES VALUES DATA DISPLAY [X Y VALUE]…\n");
        return 1;
    }
    static const char *names[PARTS_MAX][CHANNELS_MAX];
    static flat_picture pictures[PARTS_MAX];
    exr_recipe parts[PARTS_MAX];
    int count = 0;
    const char *values = argv[3];
    char *rest = argv[2];
    for (char *text; count < PARTS_MAX && (text = strsep(&rest, "/")) != NULL; count++) {
        pictures[count] = (flat_picture){.patches = argv + 6, .patch_count = (argc - 6) / 3};
        parts[count] = (exr_recipe){
            .names = names[count], .envmap = -1, .value = value_at, .context = &pictures[count]};
        values = read_part(text, values, names[count], &pictures[count], &parts[count]);
        read_window(argv[4], parts[count].data);
        read_window(argv[5], parts[count].display);
    }
    image_bytes file = count > 1 ? exr_parts_bytes(parts, count) : exr_bytes(parts);
    FILE *out = fopen(argv[1], "wb");
    int status = out == NULL || fwrite(file.bytes, 1, file.length, out) != file.length;
    status |= out == NULL || fclose(out) != 0;
    image_bytes_free(&file);
    return status;
}
