// How far the environment's harmonics and its split sum are from sums over the panorama's texels,
// as tables: environment_error [FILE.hdr|FILE.exr]... The studio comes first.
#include "environment/albedo.h"
#include "environment/diffuse.h"
#include "environment/glossy.h"
#include "environment/panorama.h"
#include "environment/prefiltered.h"
#include "environment/reader.h"
#include "environment/studio.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <vector>

namespace froxel::environment {
namespace {

constexpr int kNormals = 48;
constexpr uint32_t kSamples = 1 << 14;

double luminance(const glm::dvec3& rgb) {
    return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
}

glm::dvec3 normalAt(int i) {
    const double y = 1 - (2 * i + 1.0) / kNormals;
    const double r = std::sqrt(1 - y * y);
    const double around = 2 * std::numbers::pi * std::fmod(i * std::numbers::phi, 1.0);
    return {r * std::cos(around), y, r * std::sin(around)};
}

// Root mean square of differences over the mean of what is right.
struct Error {
    double squares = 0;
    double wanted = 0;
    int count = 0;

    void add(double is, double right) {
        squares += (is - right) * (is - right);
        wanted += right;
        ++count;
    }
    [[nodiscard]] double percent() const {
        return 100 * std::sqrt(squares / count) / (wanted / count);
    }
};

glm::dvec3 irradianceOverPi(const LinearImage& image, const glm::dvec3& normal) {
    glm::dvec3 sum(0);
    for (uint32_t y = 0; y < image.height_px; ++y) {
        const double weight = texelSolidAngle(image, y) / std::numbers::pi;
        for (uint32_t x = 0; x < image.width_px; ++x) {
            const double cosine = glm::dot(
                normal, directionAt({(x + 0.5) / image.width_px, (y + 0.5) / image.height_px}));
            sum += texel(image, x, y) * (std::max(0.0, cosine) * weight);
        }
    }
    return sum;
}

// What a mirror-like surface (f0 = 1) sends by one bounce, from the texels.
glm::dvec3
reflected(const LinearImage& image, const glm::dvec3& normal, double n_dot_v, double roughness) {
    const double alpha = roughness * roughness;
    const glm::dvec3 to_eye(std::sqrt(1 - n_dot_v * n_dot_v), 0, n_dot_v);
    glm::dvec3 sum(0);
    for (uint32_t i = 0; i < kSamples; ++i) {
        const glm::dvec3 half = halfVector(hammersley(i, kSamples), alpha);
        const double v_dot_h = glm::dot(to_eye, half);
        const glm::dvec3 to_light = 2 * v_dot_h * half - to_eye;
        if (to_light.z > 0) {
            sum += radianceFrom(image, aboutNormal(normal, to_light)) *
                   (4 * lobes::visibility(to_light.z, n_dot_v, alpha * alpha) * to_light.z *
                    v_dot_h / half.z);
        }
    }
    return sum / double{kSamples};
}

void tellDiffuse(const LinearImage& image) {
    const Diffuse diffuse = diffuseOf(image);
    Error error;
    for (int i = 0; i < kNormals; ++i) {
        error.add(luminance(diffuse.at(normalAt(i))),
                  luminance(irradianceOverPi(image, normalAt(i))));
    }
    std::printf(" %.1f |", error.percent());
}

// Of the mirrored direction and of one bent towards the normal where the surface is rough.
void tellGlossy(const LinearImage& image, const Prefiltered& map, double n_dot_v) {
    for (const double roughness : {0.1, 0.3, 0.6, 1.0}) {
        const double all = albedoFromTable(n_dot_v, roughness).all;
        Error mirrored;
        Error bent;
        for (int i = 0; i < kNormals; ++i) {
            const double right = luminance(reflected(image, normalAt(i), n_dot_v, roughness));
            const glm::dvec3 towards(-std::sqrt(1 - n_dot_v * n_dot_v), 0, n_dot_v);
            const auto at = [&](const glm::dvec3& direction) {
                return luminance(map.at(aboutNormal(normalAt(i), direction), roughness)) * all;
            };
            mirrored.add(at(towards), right);
            bent.add(at(lobeDirection({0, 0, 1}, towards, roughness)), right);
        }
        std::printf(" %.1f, %.1f |", mirrored.percent(), bent.percent());
    }
}

void tell(const std::string& name, const LinearImage& image) {
    const std::clock_t begin = std::clock();
    const Prefiltered map = prefilter(Pyramid(image), {});
    const double cpu_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    const float most = *std::max_element(image.rgb.begin(), image.rgb.end());
    std::printf("| %s | %ux%u | %.3g | %.4g | %.1f |", name.c_str(), image.width_px,
                image.height_px, luminance(meanRadiance(image)), static_cast<double>(most), cpu_s);
    tellDiffuse(image);
    std::printf("\n");
    for (const double n_dot_v : {1.0, 0.5, 0.1}) {
        std::printf("| %s | %.1f |", name.c_str(), n_dot_v);
        tellGlossy(image, map, n_dot_v);
        std::printf("\n");
        std::fflush(stdout);
    }
}

} // namespace
} // namespace froxel::environment

int main(int argc, char** argv) {
    namespace environment = froxel::environment;
    std::printf("| panorama | size | mean | most | prefilter, CPU s | harmonics, %% |\n"
                "| panorama | n.v | r = 0.1: mirrored, bent, %% | 0.3 | 0.6 | 1 |\n");
    environment::tell("studio", environment::studioPanorama(512));
    for (int i = 1; i < argc; ++i) {
        std::ifstream in(argv[i], std::ios::binary);
        const std::string bytes(std::istreambuf_iterator<char>(in), {});
        const auto read = environment::read(std::as_bytes(std::span(bytes)), argv[i]);
        if (!read) {
            std::fprintf(stderr, "%s\n", read.error().message.c_str());
            return 1;
        }
        for (const std::string& warning : read->warnings) {
            std::fprintf(stderr, "%s\n", warning.c_str());
        }
        environment::tell(std::filesystem::path(argv[i]).stem(), read->image);
    }
    return 0;
}
