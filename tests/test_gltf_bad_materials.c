// Tests bad materials: glint must answer every file with one line that names the object and the
// cause.
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
    {MATERIAL("\"pbrMetallicRoughness\":{\"metallicFactor\":1.5}"),
     "materials[0].pbrMetallicRoughness.metallicFactor: 1.5 is outside [0, 1]"},
    {MATERIAL("\"pbrMetallicRoughness\":{\"roughnessFactor\":-1}"),
     "roughnessFactor: -1 is outside"},
    {MATERIAL("\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1]}"),
     "baseColorFactor: not an array of 4 numbers"},
    {MATERIAL("\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,2,1]}"),
     "baseColorFactor[2]: 2 is outside [0, 1]"},
    {MATERIAL("\"emissiveFactor\":[0,-1,0]"), "materials[0].emissiveFactor[1]: -1 is outside"},
    {MATERIAL("\"alphaMode\":\"GLASS\""), "materials[0].alphaMode: \"GLASS\" is none"},
    {MATERIAL("\"normalTexture\":{\"index\":0}"),
     "normalTexture.index: 0: there is no such texture"},
    {MATERIAL("\"normalTexture\":{}"), "materials[0].normalTexture.index: missing"},
    {MATERIAL("\"extras\":{\"glint\":{\"mirror\":2}}"), "extras.glint.mirror: 2 is outside [0, 1]"},
    {MATERIAL("\"extras\":{\"glint\":1}"), "materials[0].extras.glint: 1 stands where an object"},
    {EXTENSION("KHR_materials_transmission", "\"transmissionFactor\":2"),
     "transmissionFactor: 2 is"},
    {EXTENSION("KHR_materials_ior", "\"ior\":0"),
     "KHR_materials_ior.ior: 0, which means an infini"},
    {EXTENSION("KHR_materials_ior", "\"ior\":-1.5"), "ior: -1.5 is no index of refraction"},
    {EXTENSION("KHR_materials_ior", "\"ior\":0.9"), "ior: 0.9 is no index of refraction"},
    {EXTENSION("KHR_materials_ior", "\"ior\":1e300"), "ior: 1e+300 is no index of refraction"},
    {EXTENSION("KHR_materials_volume", "\"attenuationDistance\":0"),
     "attenuationDistance: 0 is no"},
    {EXTENSION("KHR_materials_volume", "\"attenuationDistance\":1e-300"), "1e-300 is no distance"},
    {EXTENSION("KHR_materials_volume", "\"attenuationColor\":[1,1,1.5]"),
     "attenuationColor[2]: 1.5 is outside"},
    {EXTENSION("KHR_materials_volume", "\"thicknessFactor\":-1"),
     "thicknessFactor: -1 is out of ra"},
    {EXTENSION("KHR_materials_dispersion", "\"dispersion\":-1"), "dispersion: -1 is out of range"},
    {EXTENSION("KHR_materials_specular", "\"specularFactor\":1.5"),
     "specularFactor: 1.5 is outside"},
    {EXTENSION("KHR_materials_specular", "\"specularColorFactor\":[1,1]"), "not an array of 3"},
    {EXTENSION("KHR_materials_specular", "\"specularColorFactor\":[1,1,-1]"),
     "specularColorFactor[2]: -1 is out of range"},
    {EXTENSION("KHR_materials_anisotropy", "\"anisotropyStrength\":1.5"),
     "anisotropyStrength: 1.5 is outside"},
    {EXTENSION("KHR_materials_anisotropy", "\"anisotropyRotation\":\"x\""),
     "KHR_materials_anisotropy.anisotropyRotation: "},
    {EXTENSION("KHR_materials_sheen", "\"sheenColorFactor\":[0,0,1.5]"),
     "sheenColorFactor[2]: 1.5 is outside"},
    {EXTENSION("KHR_materials_sheen", "\"sheenRoughnessFactor\":-1"),
     "sheenRoughnessFactor: -1 is outside"},
    {EXTENSION("KHR_materials_diffuse_transmission", "\"diffuseTransmissionFactor\":1.5"),
     "diffuseTransmissionFactor: 1.5 is outside"},
    {EXTENSION("KHR_materials_diffuse_transmission", "\"diffuseTransmissionColorFactor\":[0,0,-1]"),
     "diffuseTransmissionColorFactor[2]: -1 is outside"},
    {EXTENSION("KHR_materials_iridescence", "\"iridescenceFactor\":2"),
     "iridescenceFactor: 2 is outside"},
    {EXTENSION("KHR_materials_iridescence", "\"iridescenceIor\":0.9"),
     "iridescenceIor: 0.9 is out of range"},
    {EXTENSION("KHR_materials_iridescence", "\"iridescenceThicknessMinimum\":-1"),
     "iridescenceThicknessMinimum: -1 is out of range"},
    {EXTENSION("KHR_materials_clearcoat", "\"clearcoatFactor\":1.5"),
     "clearcoatFactor: 1.5 is outside"},
    {EXTENSION("KHR_materials_clearcoat", "\"clearcoatRoughnessFactor\":-1"),
     "clearcoatRoughnessFactor: -1 is outside"},
    {EXTENSION("KHR_materials_clearcoat", "\"clearcoatNormalTexture\":{\"index\":0}"),
     "clearcoatNormalTexture.index: 0: there is no such texture"},
    {EXTENSION("KHR_materials_clearcoat", "\"clearcoatTexture\":{}"),
     "KHR_materials_clearcoat.clearcoatTexture.index: missing"},
    {EXTENSION("KHR_materials_emissive_strength", "\"emissiveStrength\":-1"),
     "emissiveStrength: -1 is out of range"},
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
