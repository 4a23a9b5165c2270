// json_get FILE KEY…: prints a value of a JSON file for the command-line tests. The KEYs lead to
// the value; an index enters an array. Exit status 1: the file is no JSON, or has no such value.
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    json_error_t error;
    json_t *root = argc > 1 ? json_load_file(argv[1], 0, &error) : NULL;
    if (root == NULL) {
        fprintf(stderr, "json_get: %s\n", argc > 1 ? error.text : "FILE is missing");
        return 1;
    }
    const json_t *value = root;
    for (int i = 2; i < argc && value != NULL; i++) {
        value = json_is_array(value) ? json_array_get(value, strtoul(argv[i], NULL, 10))
                                     : json_object_get(value, argv[i]);
    }
    int status = value == NULL;
    if (json_is_string(value)) {
        printf("%s\n", json_string_value(value));
    } else if (value != NULL) {
        char *text = json_dumps(value, JSON_ENCODE_ANY | JSON_COMPACT);
        printf("%s\n", text);
        free(text);
    }
    json_decref(root);
    return status;
}
