// Writes metadata as text. See description.h.
#include "image/description.h"

#include <stdio.h>
#include <stdlib.h>

static void print_entry(FILE *file, const glint_metadata *entry)
{
    switch (entry->type) {
    case GLINT_METADATA_STRING:
        fprintf(file, "%s: %s\n", entry->name, entry->string != NULL ? entry->string : "");
        break;
    case GLINT_METADATA_INT:
        fprintf(file, "%s: %d\n", entry->name, entry->integer);
        break;
    case GLINT_METADATA_FLOAT:
        fprintf(file, "%s: %g\n", entry->name, (double)entry->real);
        break;
    case GLINT_METADATA_MATRIX:
        break;
    }
}

char *glint_description_make(const glint_write_options *options)
{
    char *text = NULL;
    size_t length;
    FILE *file = open_memstream(&text, &length);
    if (file == NULL) {
        return NULL;
    }
    for (size_t i = 0; i < options->metadata_count; i++) {
        print_entry(file, &options->metadata[i]);
    }
    if (fclose(file) != 0) {
        free(text);
        return NULL;
    }
    return text;
}
