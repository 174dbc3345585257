#include "gltf/material_extensions.h"

namespace froxel::gltf {
namespace {

using scene::Material;
using Numbers = std::span<float>;

Numbers one(float& number) {
    return {&number, 1};
}
Numbers three(glm::vec3& color) {
    return {&color.x, 3};
}

constexpr MaterialFactor kIorFactors[] = {
    {"ior", FactorRange::kIor, [](Material& m) { return one(m.ior); }}};

constexpr MaterialFactor kSpecularFactors[] = {
    {"specularFactor", FactorRange::kUnit, [](Material& m) { return one(m.specular); }},
    {"specularColorFactor", FactorRange::kFromZero,
     [](Material& m) { return three(m.specular_color); }}};
constexpr MaterialTexture kSpecularTextures[] = {{"specularTexture", io::specular_slot},
                                                 {"specularColorTexture", io::specular_color_slot}};

constexpr MaterialFactor kCoatFactors[] = {
    {"clearcoatFactor", FactorRange::kUnit, [](Material& m) { return one(m.coat.strength); }, true},
    {"clearcoatRoughnessFactor", FactorRange::kUnit,
     [](Material& m) { return one(m.coat.roughness); }, true}};
constexpr MaterialTexture kCoatTextures[] = {
    {"clearcoatTexture", io::coat_slot},
    {"clearcoatRoughnessTexture", io::coat_roughness_slot},
    {"clearcoatNormalTexture", io::coat_normal_slot,
     [](Material& m) -> float& { return m.coat.normal_scale; }}};

constexpr MaterialFactor kSheenFactors[] = {
    {"sheenColorFactor", FactorRange::kUnit, [](Material& m) { return three(m.sheen.color); }},
    {"sheenRoughnessFactor", FactorRange::kUnit,
     [](Material& m) { return one(m.sheen.roughness); }}};
constexpr MaterialTexture kSheenTextures[] = {{"sheenColorTexture", io::sheen_color_slot},
                                              {"sheenRoughnessTexture", io::sheen_roughness_slot}};

constexpr MaterialFactor kAnisotropyFactors[] = {
    {"anisotropyStrength", FactorRange::kUnit,
     [](Material& m) { return one(m.anisotropy.strength); }},
    {"anisotropyRotation", FactorRange::kAny,
     [](Material& m) { return one(m.anisotropy.rotation_rad); }}};
constexpr MaterialTexture kAnisotropyTextures[] = {{"anisotropyTexture", io::anisotropy_slot}};

constexpr MaterialFactor kFilmFactors[] = {
    {"iridescenceFactor", FactorRange::kUnit, [](Material& m) { return one(m.film.strength); }},
    {"iridescenceIor", FactorRange::kFromOne, [](Material& m) { return one(m.film.ior); }},
    {"iridescenceThicknessMinimum", FactorRange::kFromZero,
     [](Material& m) { return one(m.film.least_nm); }},
    {"iridescenceThicknessMaximum", FactorRange::kFromZero,
     [](Material& m) { return one(m.film.most_nm); }}};
constexpr MaterialTexture kFilmTextures[] = {
    {"iridescenceTexture", io::film_slot},
    {"iridescenceThicknessTexture", io::film_thickness_slot}};

constexpr MaterialFactor kDiffuseTransmissionFactors[] = {
    {"diffuseTransmissionFactor", FactorRange::kUnit,
     [](Material& m) { return one(m.diffuse_transmission.strength); }},
    {"diffuseTransmissionColorFactor", FactorRange::kUnit,
     [](Material& m) { return three(m.diffuse_transmission.color); }}};
constexpr MaterialTexture kDiffuseTransmissionTextures[] = {
    {"diffuseTransmissionTexture", io::diffuse_transmission_slot},
    {"diffuseTransmissionColorTexture", io::diffuse_transmission_color_slot}};

// An attenuationDistance without end, as where a file has none, is 0.
constexpr MaterialFactor kVolumeFactors[] = {
    {"thicknessFactor", FactorRange::kFromZero,
     [](Material& m) { return one(m.volume.thickness_m); }},
    {"attenuationDistance", FactorRange::kFromZero,
     [](Material& m) { return one(m.volume.attenuation_m); }},
    {"attenuationColor", FactorRange::kUnit,
     [](Material& m) { return three(m.volume.attenuation_color); }}};
constexpr MaterialTexture kVolumeTextures[] = {{"thicknessTexture", io::thickness_slot}};

constexpr MaterialFactor kTransmissionFactors[] = {
    {"transmissionFactor", FactorRange::kUnit,
     [](Material& m) { return one(m.transmission.strength); }}};
constexpr MaterialTexture kTransmissionTextures[] = {
    {"transmissionTexture", io::transmission_slot}};

constexpr MaterialFactor kDispersionFactors[] = {
    {"dispersion", FactorRange::kFromZero,
     [](Material& m) { return one(m.transmission.dispersion); }}};

constexpr MaterialExtension kRows[] = {
    {.name = kUnlit, .what = "a colour that light does not change"},
    {.name = kEmissiveStrength, .what = "emission brighter than 1"},
    {.name = kGlossiness,
     .what = "a specular colour and glossiness in place of metalness and roughness"},
    {.name = "KHR_materials_ior",
     .what = "reflectance of a dielectric, by its index of refraction",
     .factors = kIorFactors,
     .of_dielectric = true},
    {.name = "KHR_materials_specular",
     .what = "strength and colour of a dielectric's reflection",
     .factors = kSpecularFactors,
     .textures = kSpecularTextures,
     .of_dielectric = true},
    {.name = "KHR_materials_clearcoat",
     .what = "a clear coat above the other layers",
     .factors = kCoatFactors,
     .textures = kCoatTextures,
     .present = [](const Material& m) { return m.coat.strength != 0; }},
    {.name = "KHR_materials_sheen",
     .what = "fibres that scatter light at edges, like cloth",
     .factors = kSheenFactors,
     .textures = kSheenTextures,
     .present = [](const Material& m) { return m.sheen.color != glm::vec3(0); }},
    {.name = "KHR_materials_anisotropy",
     .what = "highlights stretched in one direction, like brushed metal",
     .factors = kAnisotropyFactors,
     .textures = kAnisotropyTextures,
     .present = [](const Material& m) { return m.anisotropy.strength != 0; }},
    {.name = "KHR_materials_iridescence",
     .what = "a thin film whose colours change with the angle",
     .factors = kFilmFactors,
     .textures = kFilmTextures,
     .present = [](const Material& m) { return m.film.strength != 0; }},
    {.name = "KHR_materials_diffuse_transmission",
     .what = "scattered light from behind, as through leaves and paper",
     .factors = kDiffuseTransmissionFactors,
     .textures = kDiffuseTransmissionTextures,
     .present = [](const Material& m) { return m.diffuse_transmission.strength != 0; }},
    {.name = "KHR_materials_transmission",
     .what = "light that passes a surface, as through glass",
     .factors = kTransmissionFactors,
     .textures = kTransmissionTextures,
     .present = [](const Material& m) { return m.transmission.strength != 0; }},
    {.name = "KHR_materials_dispersion",
     .what = "colours that glass bends by different angles",
     .factors = kDispersionFactors,
     .present =
         [](const Material& m) {
             return m.transmission.strength != 0 && m.transmission.dispersion != 0;
         }},
    {.name = "KHR_materials_volume",
     .what = "a body that bends and dims transmitted light",
     .factors = kVolumeFactors,
     .textures = kVolumeTextures,
     .present = [](const Material& m) { return m.volume.thickness_m != 0; }},
};

} // namespace

std::span<const MaterialExtension> materialExtensions() {
    return kRows;
}

} // namespace froxel::gltf
