// R2, the second reference: the picture as the formulas say, in double on the host, from what a
// device says it sees and how it filters textures. Written apart from the shaders, so that it can
// catch them. Prices the G-buffer, depth reconstruction and fp32 arithmetic, not the light model;
// and, of a software device, its texture filter.
#pragma once

#include "core/error.h"
#include "core/linear_image.h"
#include "core/visibility.h"
#include "reference/texture.h"
#include "scene/scene.h"
#include "settings/settings.h"

namespace froxel::reference {

using froxel::Visibility;
using froxel::VisibleTriangle;

// How far light's way through a surface that transmits it is followed. To its exit: it is bent as
// it enters, goes as far as the material says, and is seen from the eye where it then is, as
// renderers have it; where it is scattered, it goes on from there in the directions of its lobe.
// Through the mesh: to its other sides, with all refractions and total reflections.
enum class LightWay : uint8_t { kToExit, kThroughMesh };

// Shades every pixel with every light of `settings` at `time_s` (the lights' clock), by the
// renderer and the shading model that `settings` name. Grids, lists, stages and layouts do not
// matter, nor how shadow maps are made: a ray says whether a light with shadows arrives; and what
// trades error for speed (a G-buffer layout, a lights' cut-off) is left out, so that it is priced.
// The ray through the pixel's centre meets the plane of the stated triangle in double (kPlaneGoesOn
// in rays.h says what holds for centres just outside it). Blended triangles are found by ray here
// and sorted pixel by pixel, as those that transmit light are; what is seen through these is traced
// as `way` says, without limits of a picture, without a limit of layers, and its textures are
// looked up without a footprint where a lobe scatters it; over an unlit surface they are mixed as
// the display shows them, by the exposure of the settings. Runs on every hardware thread. `scene`
// is only read.
//
// Stated model, besides glTF 2.0 with KHR_lights_punctual, KHR_materials_unlit, _ior, _specular and
// _clearcoat and KHR_texture_transform: visibility is height-correlated Smith (Heitz 2014);
// roughness is at least kLeastRoughness; attenuation as in brdf.h; missing tangents are the
// gradients of the texture coordinates over the triangle, seen by the interpolated normal; light
// from around as in around.h.
//
// Errors: kInvalidArgument where the visibility is not of the settings' size or names a triangle
// that the scene does not have, and where the settings ask for a panorama that it does not have.
[[nodiscard]] Result<LinearImage> shade(const scene::Scene& scene,
                                        const settings::ViewSettings& settings,
                                        double time_s,
                                        const Visibility& visibility,
                                        LightWay way = LightWay::kToExit);

} // namespace froxel::reference
