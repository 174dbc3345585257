#include "unit/environment/panorama_files.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfTiledOutputPart.h>

namespace froxel::environment {
namespace {

Imf::Header headerOf(const ExrLayout& layout, const std::vector<ExrChannel>& channels, int part) {
    Imf::Header header(layout.width, layout.height);
    header.compression() = layout.compression;
    header.setName("part " + std::to_string(part));
    header.setType(layout.tiled ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
    if (layout.tiled) {
        header.setTileDescription(Imf::TileDescription(3, 2, Imf::ONE_LEVEL));
    }
    if (layout.cropped) {
        header.displayWindow().max.x += 2;
    }
    if (layout.wide_gamut) {
        Imf::addChromaticities(
            header, Imf::Chromaticities({0.708F, 0.292F}, {0.170F, 0.797F}, {0.131F, 0.046F}));
    }
    for (const ExrChannel& channel : channels) {
        header.channels().insert(channel.name, Imf::Channel(channel.type));
    }
    return header;
}

} // namespace

std::string
radianceFile(const std::string& resolution, const std::string& pixels, const std::string& format) {
    return "#?RADIANCE\n" + format + "\n" + resolution + "\n" + pixels;
}

std::string exrFile(const ExrLayout& layout, const std::vector<ExrChannel>& channels) {
    std::vector<Imf::Header> headers;
    for (int part = 0; part < layout.parts; ++part) {
        headers.push_back(headerOf(layout, channels, part));
    }
    const auto width = static_cast<size_t>(layout.width);
    std::vector<std::vector<float>> values;
    std::vector<std::vector<half>> halves;
    std::vector<std::vector<uint32_t>> integers;
    Imf::FrameBuffer pixels;
    for (const ExrChannel& channel : channels) {
        auto& floats = values.emplace_back();
        auto& short_floats = halves.emplace_back();
        auto& whole = integers.emplace_back();
        for (size_t i = 0; i < width * static_cast<size_t>(layout.height); ++i) {
            floats.push_back(channel.value + static_cast<float>(i));
            short_floats.emplace_back(floats.back());
            whole.push_back(static_cast<uint32_t>(i));
        }
        const auto slice = [&](auto& from) {
            pixels.insert(channel.name,
                          Imf::Slice(channel.type, reinterpret_cast<char*>(from.data()),
                                     sizeof from[0], sizeof from[0] * width));
        };
        if (channel.type == Imf::HALF) {
            slice(short_floats);
        } else if (channel.type == Imf::FLOAT) {
            slice(floats);
        } else {
            slice(whole);
        }
    }
    Imf::StdOSStream out;
    {
        Imf::MultiPartOutputFile file(out, headers.data(), layout.parts);
        for (int part = 0; part < layout.parts; ++part) {
            if (layout.tiled) {
                Imf::TiledOutputPart tiles(file, part);
                tiles.setFrameBuffer(pixels);
                tiles.writeTiles(0, tiles.numXTiles() - 1, 0, tiles.numYTiles() - 1);
            } else {
                Imf::OutputPart lines(file, part);
                lines.setFrameBuffer(pixels);
                lines.writePixels(layout.height);
            }
        }
    }
    return out.str();
}

} // namespace froxel::environment
