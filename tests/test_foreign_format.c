// Tests that files of other formats are recognised. The beginnings come from the formats'
// specifications and from files of the programs that write them.
#include "decoder/foreign_format.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

// A file: its beginning, its name and what is said. `said` is NULL for what may be glTF.
typedef struct foreign_case {
    const char *name, *said;
    size_t length;
    const char *bytes;
} foreign_case;

// sizeof counts zero bytes within the text, and one at its end.
#define BYTES(text) sizeof(text) - 1, text

static void assert_described(const foreign_case *of, const unsigned char *head, uint64_t size)
{
    char text[256] = "";
    const size_t length = size < GLINT_FOREIGN_HEAD ? (size_t)size : GLINT_FOREIGN_HEAD;
    const glint_foreign_file file = {of->name, head, length, size};
    const bool is_foreign = glint_foreign_describe(&file, text, sizeof text);
    if (is_foreign != (of->said != NULL) || (is_foreign && strstr(text, of->said) == NULL)) {
        fail_msg("%s: \"%s\" where \"%s\" is right", of->name, text,
                 of->said != NULL ? of->said : "");
    }
    if (is_foreign) {
        assert_non_null(strstr(text, ", not glTF ("));
    }
}

static void assert_cases(const foreign_case *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        unsigned char head[GLINT_FOREIGN_HEAD] = {0};
        memcpy(head, cases[i].bytes, cases[i].length);
        assert_described(&cases[i], head, cases[i].length);
    }
}

// The names say nothing, or something else.
static void content_decides(void **state)
{
    (void)state;
    static const foreign_case cases[] = {
        {"a.glb", "a Blender file", BYTES("BLENDER-v300RENDH\0\0\0")},
        {"a", "a Blender file", BYTES("BLENDER17-01v0500REND")},
        {"a.gltf", "an FBX file", BYTES("Kaydara FBX Binary  \0\x1a\0\xe8\x1c\0\0")},
        {"a.glb", "an FBX file", BYTES("; FBX 7.4.0 project file\n; ---")},
        {"a.gltf", "a PLY file", BYTES("ply\nformat ascii 1.0\nelement vertex 8\n")},
        {"a.gltf", "a PLY file", BYTES("ply\r\nformat binary_little_endian 1.0\r\n")},
        {"a.gltf", "an STL file", BYTES("solid cube\n  facet normal 0 0 1\n    outer loop\n")},
        {"a.gltf", "a USD file", BYTES("#usda 1.0\n(\n    upAxis = \"Y\"\n)\n")},
        {"a.gltf", "a USD file", BYTES("PXR-USDC\0\x08\0\0\0\0\0\0")},
        {"a.gltf", "an Alembic file", BYTES("Ogawa\xff\0\x01\0\0\0\0\0\0\0\0")},
        {"a.gltf", "an Alembic file", BYTES("\x89HDF\r\n\x1a\n\0\0\0\0\0\x08\x08\0")},
        {"a.gltf", "a COLLADA file",
         BYTES("\xef\xbb\xbf<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<COLLADA xmlns=\"http\">")},
        {"a.gltf", "an X3D file", BYTES("<?xml version=\"1.0\"?>\n<!DOCTYPE X3D PUBLIC>\n<X3D>")},
        {"a.gltf", "a VRML file", BYTES("#VRML V2.0 utf8\n")},
        {"a.gltf", "a CAD file", BYTES("ISO-10303-21;\nHEADER;\n")},
        {"a.gltf", "a SketchUp file", BYTES("\xff\xfe\xff\x0eS\0k\0e\0t\0c\0h\0")},
        {"a.glb", "a ZIP archive", BYTES("PK\x03\x04\x14\0\0\0\x08\0")},
        {"scene.gltf", "packed by gzip", BYTES("\x1f\x8b\x08\x08\0\0\0\0")},
        {"scene.glb", "packed by Zstandard", BYTES("\x28\xb5\x2f\xfd\x24\0")},
        {"scene.glb", "an archive",
         BYTES("\xfd"
               "7zXZ\0\0\x04")},
        {"scene.glb", "an archive", BYTES("7z\xbc\xaf\x27\x1c\0\x04")},
        {"scene.glb", "an archive", BYTES("Rar!\x1a\x07\x01\0")},
        {"a.gltf", "text in UTF-16", BYTES("\xff\xfe{\0\"\0a\0")},
        {"a.gltf", "text in UTF-16", BYTES("\xfe\xff\0{\0\"\0a")},
        {"a.gltf", "text in UTF-16", BYTES("{\0\"\0a\0")},
        {"a.glb", "a pointer of Git LFS",
         BYTES("version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n")},
        {"a.gltf", "a web page", BYTES("\n\n<!DOCTYPE html>\n<html lang=\"en\">\n")},
        {"a.gltf", "a web page", BYTES("<!doctype HTML>\n<head>\n")},
        {"a.gltf", "a PDF file", BYTES("%PDF-1.7\n%\xe2\xe3\xcf\xd3\n")},
        {"a.gltf", "a lone Draco mesh", BYTES("DRACO\x02\x02\x01\x01\0\0\0")},
        {"a.gltf", "a picture", BYTES("\x89PNG\r\n\x1a\n\0\0\0\rIHDR")},
        {"a.gltf", "a picture", BYTES("\xff\xd8\xff\xe0\0\x10JFIF\0")},
        {"a.gltf", "a picture", BYTES("\x76\x2f\x31\x01\x02\0\0\0")},
        {"a.gltf", "a picture", BYTES("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n")},
        {"a.gltf", "a picture", BYTES("RIFF\x24\0\0\0WEBPVP8 ")},
        {"a.gltf", "a picture", BYTES("MM\0\x2a\0\0\0\x08")},
        {"a.gltf", "a picture", BYTES("II\x2a\0\x08\0\0\0")},
        {"a.gltf", "a picture", BYTES("DDS |\0\0\0")},
        {"a.gltf", "a picture", BYTES("\xabKTX 20\xbb\r\n\x1a\n")},
        {"a.gltf", "a picture", BYTES("GIF89a\x01\0\x01\0")},
    };
    assert_cases(cases, sizeof cases / sizeof *cases);
}

static void names_tell_what_content_does_not(void **state)
{
    (void)state;
    static const foreign_case cases[] = {
        {"car.obj", "a Wavefront OBJ file", BYTES("# exported\nmtllib car.mtl\nv 0 0 0\n")},
        {"x.d/CAR.OBJ", "a Wavefront OBJ file", BYTES("v 0 0 0\n")},
        {"car.mtl", "the materials of a Wavefront OBJ file", BYTES("newmtl paint\nKd 1 0 0\n")},
        {"car.stl", "an STL file", BYTES("a header that says nothing")},
        {"car.3ds", "a 3DS file", BYTES("??")},
        {"car.abc", "an Alembic file", BYTES("??")},
        {"car.dae", "a COLLADA file", BYTES("??")},
        {"car.max", "a 3ds Max file", BYTES("\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1")},
        {"car.c4d", "a Cinema 4D file", BYTES("??")},
        {"car.step", "a CAD file", BYTES("??")},
        {"car.bin", "a buffer", BYTES("\0\0\x80\x3f")},
        {"car.tga", "a picture", BYTES("\0\0\x02\0\0\0\0\0")},
        {"car.xml", "an XML file", BYTES("<?xml version=\"1.0\"?>\n<other/>\n")},
        // What is inside is named, and not the packing.
        {"car.usdz", "a USD file", BYTES("PK\x03\x04\x0a\0\0\0\0\0")},
        {"car.3mf", "a 3MF file", BYTES("PK\x03\x04\x14\0\x06\0\x08\0")},
        {"car.blend", "a Blender file", BYTES("\x28\xb5\x2f\xfd\x24\0")},
        {"car.blend1", "a Blender file", BYTES("\x1f\x8b\x08\0\0\0\0\0")},
        {"car.blend.gz", "packed by gzip", BYTES("\x1f\x8b\x08\0\0\0\0\0")},
    };
    assert_cases(cases, sizeof cases / sizeof *cases);
}

static void what_may_be_gltf_is_left_to_the_loader(void **state)
{
    (void)state;
    static const foreign_case cases[] = {
        {"a.gltf", NULL, BYTES("{\"asset\": {\"version\": \"2.0\"}}")},
        {"a.obj", NULL, BYTES(" \t\r\n{\"asset\": {\"version\": \"2.0\"}}")},
        {"a.png", NULL, BYTES("\xef\xbb\xbf{\"asset\": {}}")},
        {"a.zip", NULL, BYTES("glTF\x02\0\0\0")},
        {"a.gltf", NULL, BYTES("[]")},
        {"a.glb", NULL, BYTES("")},
        {"a.gltf", NULL, BYTES("solid cube")},
        {"a.gltf", NULL, BYTES("ply")},
        {"obj", NULL, BYTES("v 0 0 0\n")},
        {"a.obj/b", NULL, BYTES("v 0 0 0\n")},
        {"a.", NULL, BYTES("v 0 0 0\n")},
        {"a.ob", NULL, BYTES("v 0 0 0\n")},
        {"a.objx", NULL, BYTES("v 0 0 0\n")},
        {"a. ", NULL, BYTES("v 0 0 0\n")},
    };
    assert_cases(cases, sizeof cases / sizeof *cases);
}

// Little-endian.
static void put_number(unsigned char *bytes, uint32_t number)
{
    for (int i = 0; i < 4; i++) {
        bytes[i] = (unsigned char)(number >> 8 * i);
    }
}

static void lengths_tell_binary_formats(void **state)
{
    (void)state;
    // A binary STL file may have any header, even "solid" or "MM".
    for (uint32_t triangles = 1; triangles < 80000000; triangles *= 7) {
        unsigned char head[GLINT_FOREIGN_HEAD] = "solid by exporter";
        put_number(head + 80, triangles);
        const uint64_t size = 84 + UINT64_C(50) * triangles;
        assert_described(&(foreign_case){.name = "a.gltf", .said = "an STL file"}, head, size);
        assert_described(&(foreign_case){.name = "a.gltf"}, head, size + 1);
    }
    unsigned char head[GLINT_FOREIGN_HEAD] = "MM";
    put_number(head + 2, 5000);
    head[6] = 2;
    assert_described(&(foreign_case){.name = "a.gltf", .said = "a 3DS file"}, head, 5000);
    assert_described(&(foreign_case){.name = "a.gltf"}, head, 5001);
    // A TIFF whose first bytes, read as a length, are the file's.
    unsigned char tiff[GLINT_FOREIGN_HEAD] = {'M', 'M', 0, 42, 0, 0, 0, 8};
    assert_described(&(foreign_case){.name = "a.gltf", .said = "a picture"}, tiff, 10752);
    unsigned char tar[GLINT_FOREIGN_HEAD] = "scene.gltf";
    memcpy(tar + 257, "ustar  ", 8);
    assert_described(&(foreign_case){.name = "a", .said = "an archive"}, tar, 10240);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(content_decides),
        cmocka_unit_test(names_tell_what_content_does_not),
        cmocka_unit_test(what_may_be_gltf_is_left_to_the_loader),
        cmocka_unit_test(lengths_tell_binary_formats),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
