// What the passes of a JPEG have in common. The layout of the workgroup is declared before.
#include "interface/jpeg_io.h"
#include "lib/group_scan.glsl"

layout(constant_id = 0) const uint kSampling = 2; // luma samples a chroma sample, each way
layout(constant_id = 1) const bool kFast = true;  // which transform

layout(set = 0, binding = 0, scalar) readonly buffer PixelBlock { uint pixels[]; };
layout(set = 0, binding = 1, scalar) readonly buffer TableBlock { JpegTables tables[2]; };
layout(set = 0, binding = 2, scalar) buffer RunBlock { JpegRun runs[]; };
layout(set = 0, binding = 3, scalar) buffer PlaceBlock { JpegPlace places[]; }; // and the end
layout(set = 0, binding = 4, scalar) buffer CodeBlock { uint codes[]; };        // by run
layout(set = 0, binding = 5, scalar) writeonly buffer FileBlock { uint file[]; };
layout(push_constant, scalar) uniform PictureBlock { JpegPicture picture; };

const uint kUnitBlocks = kSampling * kSampling + 2u;
const uint kGroupUnits = kJpegGroupBlocks / kUnitBlocks;

uint scanBytes() { return (places[picture.run_count].bit + 7u) / 8u; }

// With what is stuffed, and the marker of the end.
uint stuffedScanBytes() { return scanBytes() + places[picture.run_count].stuffed + 2u; }
