// Quotes words for shells. See shell_word.h.
#include "cli/common/shell_word.h"

#include <stdlib.h>
#include <string.h>

// True if a POSIX shell takes the word literally without quotes.
static bool is_plain(const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_-+=./,:@%";
    return word[0] != '\0' && word[strspn(word, plain)] == '\0';
}

void glint_put_shell_word(const char *word, FILE *out)
{
    if (is_plain(word)) {
        fputs(word, out);
        return;
    }
    fputc('\'', out);
    for (; *word != '\0'; word++) {
        if (*word == '\'') {
            fputs("'\\''", out);
        } else {
            fputc(*word, out);
        }
    }
    fputc('\'', out);
}

char *glint_command_line(const glint_arguments *arguments)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out == NULL) {
        return NULL;
    }
    fputs("glint", out);
    for (int i = 0; i < arguments->word_count; i++) {
        fputc(' ', out);
        glint_put_shell_word(arguments->words[i], out);
    }
    const bool failed = ferror(out) != 0;
    if (fclose(out) != 0 || failed) {
        free(text);
        return NULL;
    }
    return text;
}
