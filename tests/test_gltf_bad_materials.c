// Tests materials that are no glTF: glint must answer every file with one line that names the
// object and the cause. Numbers out of range are in test_gltf_material_faults.c.
#include "scene/scene.h"

#include "support/gltf_text.h"
#include "support/scratch.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#define MATERIAL(text)                                                                             \
    TETRAHEDRON ",\"nodes\":[{\"mesh\":0}]," ONE_SCENE ",\"materials\":[{" text "}]"
#define EXTENSION(name, text) MATERIAL("\"extensions\":{\"" name "\":{" text "}}")

static const struct {
    const char *rest, *said;
} cases[] = {
    {MATERIAL("\"pbrMetallicRoughness\":{\"metallicFactor\":\"1\"}"),
     "materials[0].pbrMetallicRoughness.metallicFactor: the text \"1\" stands where a finite"},
    {MATERIAL("\"pbrMetallicRoughness\":7"),
     "materials[0].pbrMetallicRoughness: 7 stands where an object"},
    {MATERIAL("\"pbrMetallicRoughness\":{\"baseColorFactor\":1}"),
     "baseColorFactor: 1 stands where an array"},
    {MATERIAL("\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,true,1,1]}"),
     "baseColorFactor[1]: true stands where a finite number"},
    {MATERIAL("\"alphaMode\":1"), "materials[0].alphaMode: 1 stands where a text"},
    {MATERIAL("\"doubleSided\":1"), "materials[0].doubleSided: 1 stands where true or false"},
    {MATERIAL("\"extras\":{\"glint\":1}"), "materials[0].extras.glint: 1 stands where an object"},
    {EXTENSION("KHR_materials_ior", "\"ior\":\"glass\""),
     "materials[0].extensions.KHR_materials_ior.ior: the text \"glass\" stands where"},
    {EXTENSION("KHR_materials_volume", "\"attenuationDistance\":[]"),
     "KHR_materials_volume.attenuationDistance: an array stands where a finite number"},
    {EXTENSION("KHR_materials_anisotropy", "\"anisotropyRotation\":\"x\""),
     "KHR_materials_anisotropy.anisotropyRotation: "},
    {MATERIAL("\"extensions\":{\"KHR_materials_unlit\":true}"),
     "KHR_materials_unlit: true stands where an object must stand"},
};

static void every_mistake_is_named(void **state)
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_rest_refused(*state, cases[i].rest, cases[i].said);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_mistake_is_named)};
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
