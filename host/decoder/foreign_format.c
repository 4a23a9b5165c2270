// Recognises files that are not glTF. See foreign_format.h.
#include "decoder/foreign_format.h"

#include "image/formats.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

// ---- The formats -------------------------------------------------------------------------------

// Ways to glTF.
#define SAVED "in Blender: File > Export > glTF 2.0"
#define IMPORTED "import it in Blender, then File > Export > glTF 2.0"
#define MADE "export glTF from the program that made it"
#define UNPACKED "unpack it, and give the .gltf or .glb file"
#define PACKED_BY_GZIP "unpack it with gunzip, and give the .gltf or .glb file"

typedef enum kind {
    FOREIGN_BLENDER,
    FOREIGN_FBX,
    FOREIGN_OBJ,
    FOREIGN_MTL,
    FOREIGN_STL,
    FOREIGN_PLY,
    FOREIGN_USD,
    FOREIGN_ALEMBIC,
    FOREIGN_COLLADA,
    FOREIGN_3DS,
    FOREIGN_X3D,
    FOREIGN_VRML,
    FOREIGN_LIGHTWAVE,
    FOREIGN_3MF,
    FOREIGN_CAD,
    FOREIGN_CINEMA,
    FOREIGN_MAYA,
    FOREIGN_MAX,
    FOREIGN_SKETCHUP,
    FOREIGN_HOUDINI,
    FOREIGN_RENDERER,
    FOREIGN_TILE,
    FOREIGN_DRACO,
    FOREIGN_BUFFER,
    FOREIGN_ZIP,
    FOREIGN_GZIP,
    FOREIGN_ZSTD,
    FOREIGN_ARCHIVE,
    FOREIGN_XML,
    FOREIGN_PAGE,
    FOREIGN_POINTER,
    FOREIGN_UTF16,
    FOREIGN_PDF,
    FOREIGN_PICTURE,
    FOREIGN_UNKNOWN,
} kind;

// What a message says about a kind, and the extensions of its files, each followed by a space.
static const struct {
    const char *what, *way, *extensions;
} facts[] = {
    [FOREIGN_BLENDER] = {"a Blender file", SAVED, "blend blend1 "},
    [FOREIGN_FBX] = {"an FBX file", IMPORTED, "fbx "},
    [FOREIGN_OBJ] = {"a Wavefront OBJ file", IMPORTED, "obj "},
    [FOREIGN_MTL] = {"the materials of a Wavefront OBJ file",
                     "import the .obj file in Blender, then File > Export > glTF 2.0", "mtl "},
    [FOREIGN_STL] = {"an STL file", IMPORTED, "stl "},
    [FOREIGN_PLY] = {"a PLY file", IMPORTED, "ply "},
    [FOREIGN_USD] = {"a USD file", IMPORTED, "usd usda usdc usdz "},
    [FOREIGN_ALEMBIC] = {"an Alembic file", IMPORTED, "abc "},
    [FOREIGN_COLLADA] = {"a COLLADA file", IMPORTED, "dae "},
    [FOREIGN_3DS] = {"a 3DS file", IMPORTED, "3ds "},
    [FOREIGN_X3D] = {"an X3D file", IMPORTED, "x3d x3dv "},
    [FOREIGN_VRML] = {"a VRML file", IMPORTED, "wrl vrml "},
    [FOREIGN_LIGHTWAVE] = {"a LightWave file", MADE, "lwo lws "},
    [FOREIGN_3MF] = {"a 3MF file", MADE, "3mf "},
    [FOREIGN_CAD] = {"a CAD file", MADE,
                     "step stp iges igs 3dm dwg dxf sldprt sldasm ipt iam catpart catproduct jt "
                     "x_t x_b ifc "},
    [FOREIGN_CINEMA] = {"a Cinema 4D file", MADE, "c4d "},
    [FOREIGN_MAYA] = {"a Maya file", MADE, "ma mb "},
    [FOREIGN_MAX] = {"a 3ds Max file", MADE, "max "},
    [FOREIGN_SKETCHUP] = {"a SketchUp file", MADE, "skp "},
    [FOREIGN_HOUDINI] = {"a Houdini file", MADE, "hip hiplc hipnc bgeo "},
    [FOREIGN_RENDERER] = {"a scene of another renderer", MADE, "pbrt pov mi ass rib vrscene lxs "},
    [FOREIGN_TILE] = {"a tile of 3D Tiles", "take the .glb file out of it", "b3dm i3dm cmpt pnts "},
    [FOREIGN_DRACO] = {"a lone Draco mesh", "give a .gltf or .glb file that holds it", "drc "},
    [FOREIGN_BUFFER] = {"a buffer", "give the .gltf file that names it", "bin "},
    [FOREIGN_ZIP] = {"a ZIP archive", UNPACKED, "zip "},
    [FOREIGN_GZIP] = {"packed by gzip", PACKED_BY_GZIP, "gz tgz "},
    [FOREIGN_ZSTD] = {"packed by Zstandard", UNPACKED, "zst "},
    [FOREIGN_ARCHIVE] = {"an archive", UNPACKED, "tar 7z rar xz bz2 "},
    [FOREIGN_XML] = {"an XML file", MADE, "xml "},
    [FOREIGN_PAGE] = {"a web page", "download the file that the page shows", "html htm "},
    [FOREIGN_POINTER] = {"a pointer of Git LFS", "git lfs pull fetches the file itself", ""},
    [FOREIGN_UTF16] = {"text in UTF-16", "save it in UTF-8", ""},
    [FOREIGN_PDF] = {"a PDF file", MADE, "pdf "},
    [FOREIGN_PICTURE] = {"a picture",
                         "give a scene; a picture can light it: glint render SCENE --env FILE",
                         "png jpg jpeg exr hdr tif tiff webp dds ktx ktx2 tga bmp gif psd svg "},
};

// ---- By content --------------------------------------------------------------------------------

// The first bytes of a format's files.
typedef struct magic {
    const char *bytes;
    size_t offset, length;
    kind kind;
} magic;

static const magic magics[] = {
    {"BLENDER", 0, 7, FOREIGN_BLENDER},
    {"Kaydara FBX Binary", 0, 18, FOREIGN_FBX},
    {"; FBX ", 0, 6, FOREIGN_FBX},
    {"ply\n", 0, 4, FOREIGN_PLY},
    {"ply\r", 0, 4, FOREIGN_PLY},
    {"#usda ", 0, 6, FOREIGN_USD},
    {"PXR-USDC", 0, 8, FOREIGN_USD},
    {"Ogawa", 0, 5, FOREIGN_ALEMBIC},
    {"\x89HDF\r\n\x1a\n", 0, 8, FOREIGN_ALEMBIC},
    {"#VRML", 0, 5, FOREIGN_VRML},
    {"LWO", 8, 3, FOREIGN_LIGHTWAVE},
    {"ISO-10303-21;", 0, 13, FOREIGN_CAD},
    {"3D Geometry File Format", 0, 23, FOREIGN_CAD},
    {"AC10", 0, 4, FOREIGN_CAD},
    {"QC4DC4D6", 0, 8, FOREIGN_CINEMA},
    {"//Maya ASCII", 0, 12, FOREIGN_MAYA},
    {"b3dm", 0, 4, FOREIGN_TILE},
    {"i3dm", 0, 4, FOREIGN_TILE},
    {"cmpt", 0, 4, FOREIGN_TILE},
    {"pnts", 0, 4, FOREIGN_TILE},
    {"DRACO", 0, 5, FOREIGN_DRACO},
    {"PK\x03\x04", 0, 4, FOREIGN_ZIP},
    {"PK\x05\x06", 0, 4, FOREIGN_ZIP},
    {"\x1f\x8b", 0, 2, FOREIGN_GZIP},
    {"\x28\xb5\x2f\xfd", 0, 4, FOREIGN_ZSTD},
    {"\xfd"
     "7zXZ",
     0, 5, FOREIGN_ARCHIVE},
    {"BZh", 0, 3, FOREIGN_ARCHIVE},
    {"7z\xbc\xaf\x27\x1c", 0, 6, FOREIGN_ARCHIVE},
    {"Rar!", 0, 4, FOREIGN_ARCHIVE},
    {"ustar", 257, 5, FOREIGN_ARCHIVE},
    {"version https://git-lfs", 0, 23, FOREIGN_POINTER},
    {"\xff\xfe\xff\x0e", 0, 4, FOREIGN_SKETCHUP},
    {"\xff\xfe", 0, 2, FOREIGN_UTF16},
    {"\xfe\xff", 0, 2, FOREIGN_UTF16},
    {"{\0", 0, 2, FOREIGN_UTF16},
    {"\0{", 0, 2, FOREIGN_UTF16},
    {"%PDF-", 0, 5, FOREIGN_PDF},
    {"\xabKTX ", 0, 5, FOREIGN_PICTURE},
    {"qoif", 0, 4, FOREIGN_PICTURE},
};

static kind kind_of_magic(const glint_foreign_file *file)
{
    for (size_t i = 0; i < COUNT(magics); i++) {
        const magic *known = &magics[i];
        if (file->length >= known->offset + known->length &&
            memcmp(file->head + known->offset, known->bytes, known->length) == 0) {
            return known->kind;
        }
    }
    return FOREIGN_UNKNOWN;
}

// The head as a text that begins at its first visible character. Zero bytes become spaces.
static void take_text(const glint_foreign_file *file, char text[GLINT_FOREIGN_HEAD + 1])
{
    size_t begin = file->length >= 3 && memcmp(file->head, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    while (begin < file->length && strchr(" \t\r\n", file->head[begin]) != NULL &&
           file->head[begin] != '\0') {
        begin++;
    }
    size_t length = 0;
    for (size_t i = begin; i < file->length; i++) {
        text[length++] = (char)(file->head[i] != '\0' ? file->head[i] : ' ');
    }
    text[length] = '\0';
}

// The kind of a text with tags; UNKNOWN if it has none.
static kind kind_of_tags(const char *text)
{
    static const struct {
        const char *tag;
        kind kind;
    } tags[] = {
        {"<COLLADA", FOREIGN_COLLADA},    {"<X3D", FOREIGN_X3D},
        {"<!DOCTYPE html", FOREIGN_PAGE}, {"<html", FOREIGN_PAGE},
        {"<scene ", FOREIGN_RENDERER},    {"<svg", FOREIGN_PICTURE},
        {"<?xml", FOREIGN_XML},
    };
    for (size_t i = 0; text[0] == '<' && i < COUNT(tags); i++) {
        if (strcasestr(text, tags[i].tag) != NULL) {
            return tags[i].kind;
        }
    }
    return FOREIGN_UNKNOWN;
}

static uint32_t little_endian(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
           (uint32_t)bytes[3] << 24;
}

// A 3DS file begins with a chunk that is as long as the file, and its version or its editor's chunk
// follows. A binary STL file has 84 bytes and 50 for each triangle.
static kind kind_of_lengths(const glint_foreign_file *file)
{
    const unsigned char *head = file->head;
    if (file->length >= 8 && memcmp(head, "MM", 2) == 0 && little_endian(head + 2) == file->size &&
        (memcmp(head + 6, "\x02\x00", 2) == 0 || memcmp(head + 6, "==", 2) == 0)) {
        return FOREIGN_3DS;
    }
    const bool is_stl =
        file->length >= 134 && file->size == 84 + UINT64_C(50) * little_endian(head + 80);
    return is_stl ? FOREIGN_STL : FOREIGN_UNKNOWN;
}

// ---- By name -----------------------------------------------------------------------------------

static kind kind_of_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash != NULL ? slash : path, '.');
    const size_t length = dot != NULL ? strlen(dot + 1) : 0;
    for (size_t i = 0; length > 0 && i < COUNT(facts); i++) {
        for (const char *word = facts[i].extensions; *word != '\0';) {
            const size_t word_length = strcspn(word, " ");
            if (word_length == length && strncasecmp(word, dot + 1, length) == 0) {
                return (kind)i;
            }
            word += word_length + 1;
        }
    }
    return FOREIGN_UNKNOWN;
}

// The kind of a packed file: what is inside, if the name says so.
static kind kind_inside(kind packing, const char *path)
{
    const kind named = kind_of_name(path);
    const bool is_usd = packing == FOREIGN_ZIP && named == FOREIGN_USD;
    const bool is_3mf = packing == FOREIGN_ZIP && named == FOREIGN_3MF;
    const bool is_blender =
        (packing == FOREIGN_GZIP || packing == FOREIGN_ZSTD) && named == FOREIGN_BLENDER;
    return is_usd || is_3mf || is_blender ? named : packing;
}

// ---- The verdict -------------------------------------------------------------------------------

static kind find_kind(const glint_foreign_file *file)
{
    if (file->length >= 4 && memcmp(file->head, "glTF", 4) == 0) {
        return FOREIGN_UNKNOWN;
    }
    const kind by_lengths = kind_of_lengths(file), by_magic = kind_of_magic(file);
    if (by_lengths != FOREIGN_UNKNOWN) {
        return by_lengths;
    }
    if (by_magic != FOREIGN_UNKNOWN) {
        return kind_inside(by_magic, file->path);
    }
    if (glint_image_format_name(file->head, file->length) != NULL) {
        return FOREIGN_PICTURE;
    }
    char text[GLINT_FOREIGN_HEAD + 1];
    take_text(file, text);
    if (text[0] == '{') {
        return FOREIGN_UNKNOWN;
    }
    if (strncmp(text, "solid", 5) == 0 && strstr(text, "facet") != NULL) {
        return FOREIGN_STL;
    }
    const kind by_tags = kind_of_tags(text);
    return by_tags != FOREIGN_UNKNOWN ? by_tags : kind_of_name(file->path);
}

bool glint_foreign_describe(const glint_foreign_file *file, char *text, size_t capacity)
{
    const kind found = find_kind(file);
    if (found != FOREIGN_UNKNOWN) {
        snprintf(text, capacity, "it is %s, not glTF (%s)", facts[found].what, facts[found].way);
    }
    return found != FOREIGN_UNKNOWN;
}
