#include "render/frame/frame_uniforms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace froxel::render {

namespace {

double toonAt(const io::Frame& frame, double x) {
    io::ToonSegment s = frame.toon[0];
    for (const auto& segment : frame.toon) {
        s = x >= static_cast<double>(segment.x0) ? segment : s;
    }
    const double u = x - static_cast<double>(s.x0);
    const auto d = [](float f) { return static_cast<double>(f); };
    return ((d(s.a) * u + d(s.b)) * u + d(s.c)) * u + d(s.d);
}

io::Frame frameFor(const settings::ViewSettings& settings, double far_m = 100) {
    const auto projection = makeProjection(settings.camera, settings.size, far_m);
    return makeFrameUniforms(settings, projection, nullptr, 0, 0);
}

// Depth of a point at a distance, as the vertex stage makes it; and back.
double roundTrip(const io::Frame& f, double distance) {
    const auto d = [](float x) { return static_cast<double>(x); };
    const double z = -distance;
    const double depth = (d(f.camera.clip_z.x) + d(f.camera.clip_z.y) * z) /
                         (d(f.camera.clip_w.x) + d(f.camera.clip_w.y) * z);
    return (d(f.camera.distance_num.x) + d(f.camera.distance_num.y) * depth) /
           (d(f.camera.distance_den.x) + d(f.camera.distance_den.y) * depth);
}

} // namespace

TEST(FrameUniforms, Depth_BothProjections_GivesTheDistanceBack) {
    for (const auto kind :
         {settings::Projection::kPerspective, settings::Projection::kOrthographic}) {
        settings::ViewSettings settings;
        settings.camera.projection = kind;
        const auto frame = frameFor(settings);
        for (const double distance : {0.06, 1.0, 12.5, 99.0}) {
            // Orthographic depth is linear: its error is a share of the whole range of 100 m.
            const double share = kind == settings::Projection::kPerspective ? distance : 100.0;
            EXPECT_NEAR(roundTrip(frame, distance), distance, share * 1e-6);
        }
    }
}

TEST(FrameUniforms, Ray_OfAPixelCentre_ProjectsBackToIt) {
    settings::ViewSettings settings;
    settings.size = {17, 33};
    const auto frame = frameFor(settings);
    for (const float pixel : {0.5F, 8.5F, 16.5F}) {
        const float x =
            pixel * frame.camera.ray_scale.x + frame.camera.ray_offset.x; // at distance 1
        const float ndc = x * frame.camera.clip_scale.x;
        EXPECT_NEAR((ndc + 1) * 0.5F * 17, pixel, 1e-4F);
    }
    EXPECT_GT(frame.camera.ray_offset.y, 0); // the top row looks up
}

// The middle pixel of a shifted picture looks half a picture to the right and a quarter down.
TEST(FrameUniforms, ShiftedLens_MovesRaysAndProjectionAlike) {
    for (const auto kind :
         {settings::Projection::kPerspective, settings::Projection::kOrthographic}) {
        settings::ViewSettings settings;
        settings.size = {640, 360};
        settings.camera.projection = kind;
        settings.camera.lens_shift = {0.5, -0.25};
        const auto frame = frameFor(settings);
        const double half_y = kind == settings::Projection::kPerspective
                                  ? std::tan(settings.camera.yfov_rad / 2)
                                  : settings.camera.half_height_m;
        const glm::vec2 ray =
            glm::vec2(320, 180) * frame.camera.ray_scale + frame.camera.ray_offset;
        EXPECT_NEAR(ray.x, 0.5 * half_y * 640 / 360, 1e-5);
        EXPECT_NEAR(ray.y, -0.25 * half_y, 1e-5);
        const float distance = 7;
        const glm::vec2 xy =
            ray * (frame.camera.ray_spread.x + frame.camera.ray_spread.y * distance);
        const float w = frame.camera.clip_w.x - frame.camera.clip_w.y * distance;
        const glm::vec2 clip = xy * frame.camera.clip_scale + frame.camera.clip_offset * w;
        EXPECT_NEAR(clip.x / w, 0, 1e-6);
        EXPECT_NEAR(clip.y / w, 0, 1e-6);
    }
}

TEST(FrameUniforms, Toon_HermitePoints_AreMetWithTheirSlopes) {
    settings::ViewSettings settings;
    settings.toon_fragment.count = 3;
    settings.toon_fragment.points[0] = {0.1F, 0.2F, 0.5F};
    settings.toon_fragment.points[1] = {0.4F, 0.6F, -1.0F};
    settings.toon_fragment.points[2] = {0.9F, 0.8F, 2.0F};
    const auto frame = frameFor(settings);
    EXPECT_NEAR(toonAt(frame, 0.0), 0.2, 1e-6);
    EXPECT_NEAR(toonAt(frame, 0.1), 0.2, 1e-6);
    EXPECT_NEAR(toonAt(frame, 0.4), 0.6, 1e-6);
    EXPECT_NEAR(toonAt(frame, 0.4 - 1e-6), 0.6, 1e-5);
    EXPECT_NEAR(toonAt(frame, 0.9 - 1e-6), 0.8, 1e-5);
    EXPECT_NEAR(toonAt(frame, 5.0), 0.8, 1e-6);
    EXPECT_NEAR((toonAt(frame, 0.401) - toonAt(frame, 0.4)) / 0.001, -1.0, 0.05);
    EXPECT_NEAR((toonAt(frame, 0.8999) - toonAt(frame, 0.8989)) / 0.001, 2.0, 0.05);
}

} // namespace froxel::render
