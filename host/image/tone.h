// Applies tone curves: they map unlimited light to the range of an 8-bit file.
#ifndef GLINT_IMAGE_TONE_H
#define GLINT_IMAGE_TONE_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum glint_tone {
    GLINT_TONE_NONE,        // the sRGB encoding clips values above 1
    GLINT_TONE_PBR_NEUTRAL, // Khronos PBR Neutral: github.com/KhronosGroup/ToneMapping
    GLINT_TONE_AGX,         // AgX with Blender's base look, as three.js and Filament compute it
} glint_tone;

// The names on the command line, in the order of the enum; NULL at the end.
extern const char *const glint_tone_names[];

// Maps a colour in place: linear, unpremultiplied, Rec. 709 primaries, after exposure. The result
// is linear and within [0, 1]. NaN and negative values count as 0, infinity as the largest float.
// GLINT_TONE_NONE changes nothing.
void glint_tone_map(glint_tone tone, float rgb[3]);

#ifdef __cplusplus
}
#endif

#endif
