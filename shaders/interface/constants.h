// Specialisation constants, flag bits and limits that C++ and GLSL agree on.
#ifndef FROXEL_INTERFACE_CONSTANTS_H
#define FROXEL_INTERFACE_CONSTANTS_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

// Specialisation constant ids; every shader uses the same five.
FROXEL_CONST uint kSpecMaterialFlags = 0U;
FROXEL_CONST uint kSpecLightFlags = 1U;
FROXEL_CONST uint kSpecOutputFlags = 2U;
FROXEL_CONST uint kSpecBatchSize = 3U;        // lights fetched together; see kLightBatched
FROXEL_CONST uint kSpecMaterialTextures = 4U; // a bit a slot of interface/material_slots.h

// Material flags: what a draw's material has beside textures.
FROXEL_CONST uint kMaterialMask = 1U << 0;
FROXEL_CONST uint kMaterialUnlit = 1U << 1;
FROXEL_CONST uint kMaterialDoubleSided = 1U << 2;
FROXEL_CONST uint kMaterialUvTransform = 1U << 3; // a slot has a transform or TEXCOORD_1
FROXEL_CONST uint kMaterialExtended = 1U << 4;    // vertices carry uv1, colour and tangent
FROXEL_CONST uint kMaterialTangents = 1U << 5;    // the tangents are from the file
FROXEL_CONST uint kMaterialBlend = 1U << 6;
FROXEL_CONST uint kMaterialSpecular = 1U << 7;             // reflects unlike a usual dielectric
FROXEL_CONST uint kMaterialGlossiness = 1U << 8;           // in A of the specular colour
FROXEL_CONST uint kMaterialCoat = 1U << 9;                 // a clear coat over it
FROXEL_CONST uint kMaterialSheen = 1U << 10;               // fibres over it, below its coat
FROXEL_CONST uint kMaterialAnisotropy = 1U << 11;          // highlights of two roughnesses
FROXEL_CONST uint kMaterialFilm = 1U << 12;                // iridescence
FROXEL_CONST uint kMaterialDiffuseTransmission = 1U << 13; // light comes through it, scattered
FROXEL_CONST uint kMaterialTransmission = 1U << 15; // light comes through it, as through glass
// And with that: it has a thickness; which bends colours by different angles; it blurs what is
// behind.
FROXEL_CONST uint kMaterialBody = 1U << 16;
FROXEL_CONST uint kMaterialDispersion = 1U << 17;
FROXEL_CONST uint kMaterialFrosted = 1U << 18;
// Of the device, not of a material: lib/fragment_material.glsl takes gradients by itself.
FROXEL_CONST uint kMaterialGradients = 1U << 14;
// Layers, of which lights add up what each reflects; and what else the G-buffer has no room for.
// The shaders of FROXEL_LAYERED alone know them.
FROXEL_CONST uint kMaterialLitLayers =
    kMaterialCoat | kMaterialSheen | kMaterialDiffuseTransmission | kMaterialTransmission;
FROXEL_CONST uint kMaterialLayers = kMaterialLitLayers | kMaterialAnisotropy | kMaterialFilm;

// Light flags: which lights a frame has and how they are looped over.
FROXEL_CONST uint kLightLocal = 1U << 0; // any light that has a place
FROXEL_CONST uint kLightLists = 1U << 1; // through cluster lists; else all lights
FROXEL_CONST uint kLightSpots = 1U << 2; // some of the local lights are spots
FROXEL_CONST uint kLightDirectional = 1U << 3;
FROXEL_CONST uint kLightBatched = 1U << 4;       // a subgroup fetches lights together
FROXEL_CONST uint kLightToon = 1U << 5;          // n.l through the toon ramp
FROXEL_CONST uint kLightPartial = 1U << 6;       // batched where a subgroup may lack invocations
FROXEL_CONST uint kLightLambert = 1U << 7;       // settings::ShadingModel::kLambert
FROXEL_CONST uint kLightEqualRadii = 1U << 8;    // Frame::light_inv_radius2 is every light's
FROXEL_CONST uint kLightCulled = 1U << 9;        // batched, and what a subgroup can skip is skipped
FROXEL_CONST uint kLightLong = 1U << 10;         // loops take several lights an iteration
FROXEL_CONST uint kLightBlinnPhong = 1U << 11;   // settings::ShadingModel::kBlinnPhong
FROXEL_CONST uint kLightSlicesLinear = 1U << 12; // cluster::SliceLaw; neither: logarithmic
FROXEL_CONST uint kLightSlicesHyperbolic = 1U << 13;
FROXEL_CONST uint kLightAreas = 1U << 14;      // some of the spots are rectangles
FROXEL_CONST uint kLightSmallScene = 1U << 15; // Frame::light_most_inverse2, else 1 / (1 cm)^2
// Some surface reflects less than all at its edges: lights add up what it scatters there, too.
FROXEL_CONST uint kLightEdges = 1U << 16;
FROXEL_CONST uint kLightShadows = 1U << 17;     // some local lights have shadow maps
FROXEL_CONST uint kLightEnvironment = 1U << 18; // light from around, in the ambient light's place
FROXEL_CONST uint kLightBands = 1U << 19;       // with kLightToon: each light in Frame::toon_bands
// With kLightShadows: some of what they send passes surfaces that transmit light.
FROXEL_CONST uint kLightTransmitted = 1U << 21;
FROXEL_CONST uint kLightRim = 1U << 20; // toon: more light where a surface turns away

// Alpha of radiance: how much of the background is covered; this where a solid surface is unlit,
// and between 1 and this where something thin is before one.
FROXEL_CONST float kUnlitAlpha = 2.0F;

// Output flags: targets and what the last pass does.
FROXEL_CONST uint kOutputPixels = 1U << 0;      // lighting also exposes, tone maps and packs
FROXEL_CONST uint kOutputRadiance = 1U << 1;    // lighting writes linear fp32 radiance
FROXEL_CONST uint kOutputWideGbuffer = 1U << 2; // metalness, occlusion, emission are stored
FROXEL_CONST uint kOutputClamp = 1U << 3;       // plain clamp instead of the neutral tone map
FROXEL_CONST uint kOutputDepth = 1U << 4;       // the resolve replaces depths by those of planes
FROXEL_CONST uint kOutputSamples = 1U << 5;     // the tone map's pixel is the mean of 2 x 2 samples

// Of blended surfaces where others transmit light: those behind the nearest of these, or the rest.
FROXEL_CONST uint kOutputBehindTransmissive = 1U << 6;
FROXEL_CONST uint kOutputBeforeTransmissive = 1U << 7;

FROXEL_CONST float kPi = 3.14159265358979F;
FROXEL_CONST float kLeastSheenRoughness = 0.07F;
FROXEL_CONST float kDielectricF0 = 0.04F; // reflectance head-on at an index of refraction of 1.5

FROXEL_CONST uint kMaxToonSegments = 9U; // 8 points: 7 cubics and two constant ends
// What is in the middle of a light's toon bands (toonBand() of shaders/lib/frame.glsl): what
// arrives a third of its radius away from one candela, times that radius squared.
FROXEL_CONST float kToonMiddle = 9.0F;
FROXEL_CONST float kToonLeastGloss = 1.0F; // a toon highlight over what a white surface scatters
FROXEL_CONST float kToonMostGloss = 25.0F;
FROXEL_CONST uint kScreenGroup = 8U; // screen passes: workgroups of 8 x 8 pixels

FROXEL_IO_NAMESPACE_END

#endif
