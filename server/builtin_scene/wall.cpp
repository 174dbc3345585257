#include "builtin_scene/wall.h"

#include "builtin_scene/angles.h"

#include <algorithm>
#include <cmath>

namespace froxel::builtin_scene {
namespace {

// x of the points of an arc that are evenly spread by angle.
std::vector<float> arcCuts(float centre_x, float radius, uint32_t steps) {
    std::vector<float> cuts;
    for (uint32_t i = 0; i <= steps; ++i) {
        const float angle = kPi * static_cast<float>(i) / static_cast<float>(steps);
        cuts.push_back(centre_x - radius * std::cos(angle));
    }
    return cuts;
}

Curve circle(float centre_x, float centre_y, float radius, float side) {
    return [=](float x) {
        const float dx = x - centre_x;
        return centre_y + side * std::sqrt(std::max(0.0F, radius * radius - dx * dx));
    };
}

// What a wall's solid parts are between two neighbouring cuts: pairs of curves, bottom to top.
struct Strip {
    float x0, x1;
    std::vector<const Curve*> curves;
};

// Triangles between two upright edges whose points ascend.
void zip(MeshBuilder& mesh,
         float x0,
         const std::vector<float>& left,
         float x1,
         const std::vector<float>& right) {
    const auto emit = [&](float x, float y) {
        const glm::vec3 position(x, y, 0);
        return mesh.vertex({position, {0, 0, 1}, planarUv(position, {0, 0, 1})});
    };
    size_t i = 0;
    size_t j = 0;
    uint32_t a = emit(x0, left[0]);
    uint32_t b = emit(x1, right[0]);
    while (i + 1 < left.size() || j + 1 < right.size()) {
        const bool climb_left =
            j + 1 == right.size() || (i + 1 < left.size() && left[i + 1] <= right[j + 1]);
        const uint32_t c = climb_left ? emit(x0, left[++i]) : emit(x1, right[++j]);
        mesh.triangle(a, b, c);
        (climb_left ? a : b) = c;
    }
}

// Keeps pointers to the curves.
std::vector<Strip> cutToStrips(const std::vector<float>& xs,
                               const Curve& bottom,
                               const Curve& top,
                               const std::vector<Opening>& openings) {
    std::vector<Strip> strips;
    for (size_t i = 0; i + 1 < xs.size(); ++i) {
        Strip strip{xs[i], xs[i + 1], {&bottom}};
        const float middle = 0.5F * (strip.x0 + strip.x1);
        std::vector<const Opening*> crossed;
        for (const Opening& opening : openings) {
            if (opening.cuts.front() < middle && middle < opening.cuts.back()) {
                crossed.push_back(&opening);
            }
        }
        std::sort(crossed.begin(), crossed.end(), [&](const Opening* a, const Opening* b) {
            return a->low(middle) < b->low(middle);
        });
        for (const Opening* opening : crossed) {
            strip.curves.insert(strip.curves.end(), {&opening->low, &opening->high});
        }
        strip.curves.push_back(&top);
        strips.push_back(std::move(strip));
    }
    return strips;
}

} // namespace

Curve level(float y) {
    return [y](float) { return y; };
}

Opening archOpening(
    float centre_x, float radius, float sill, float spring, uint32_t steps, bool open_foot) {
    Opening opening;
    opening.cuts = arcCuts(centre_x, radius, steps);
    opening.low = level(sill);
    opening.high = circle(centre_x, spring, radius, 1.0F);
    opening.outline = Profile({centre_x - radius, sill});
    if (spring > sill) {
        opening.outline.to({centre_x - radius, spring});
    }
    for (uint32_t i = 1; i <= steps; ++i) {
        opening.outline.to({opening.cuts[i], opening.high(opening.cuts[i])});
    }
    if (spring > sill) {
        opening.outline.to({centre_x + radius, sill});
    }
    if (!open_foot) {
        opening.outline.to({centre_x - radius, sill});
    }
    return opening;
}

Opening roundOpening(float centre_x, float centre_y, float radius, uint32_t steps) {
    Opening opening;
    opening.cuts = arcCuts(centre_x, radius, steps);
    opening.low = circle(centre_x, centre_y, radius, -1.0F);
    opening.high = circle(centre_x, centre_y, radius, 1.0F);
    opening.outline = Profile({opening.cuts.front(), centre_y});
    for (uint32_t i = 1; i <= steps; ++i) {
        opening.outline.to({opening.cuts[i], opening.high(opening.cuts[i])});
    }
    for (uint32_t i = steps; i-- > 0;) {
        opening.outline.to({opening.cuts[i], opening.low(opening.cuts[i])});
    }
    return opening;
}

void addWall(MeshBuilder& mesh,
             float x0,
             float x1,
             const Curve& bottom,
             const Curve& top,
             const std::vector<Opening>& openings,
             const std::vector<float>& cuts) {
    std::vector<float> xs{x0, x1};
    xs.insert(xs.end(), cuts.begin(), cuts.end());
    for (const Opening& opening : openings) {
        xs.insert(xs.end(), opening.cuts.begin(), opening.cuts.end());
    }
    std::sort(xs.begin(), xs.end());
    // Two openings one above the other have nearly equal cuts; a sliver would help nobody.
    const auto last =
        std::unique(xs.begin(), xs.end(), [](float a, float b) { return b - a < 1e-4F; });
    xs.erase(last, xs.end());

    const std::vector<Strip> strips = cutToStrips(xs, bottom, top, openings);
    std::vector<std::vector<float>> heights(xs.size()); // where any strip has a corner, by cut
    for (size_t i = 0; i < strips.size(); ++i) {
        for (const Curve* curve : strips[i].curves) {
            heights[i].push_back((*curve)(strips[i].x0));
            heights[i + 1].push_back((*curve)(strips[i].x1));
        }
    }
    for (std::vector<float>& column : heights) {
        std::sort(column.begin(), column.end());
    }
    const auto between = [&](size_t cut, float low, float high) {
        std::vector<float> ys{low};
        for (const float y : heights[cut]) {
            if (y > ys.back() + 1e-4F && y < high - 1e-4F) {
                ys.push_back(y);
            }
        }
        if (high > low) {
            ys.push_back(high);
        }
        return ys;
    };
    for (size_t i = 0; i < strips.size(); ++i) {
        const Strip& strip = strips[i];
        for (size_t k = 0; k + 1 < strip.curves.size(); k += 2) {
            const Curve& low = *strip.curves[k];
            const Curve& high = *strip.curves[k + 1];
            if (low(strip.x0) < high(strip.x0) || low(strip.x1) < high(strip.x1)) {
                zip(mesh, strip.x0, between(i, low(strip.x0), high(strip.x0)), strip.x1,
                    between(i + 1, low(strip.x1), high(strip.x1)));
            }
        }
    }
}

void addReveal(MeshBuilder& mesh, const Opening& opening, float depth_m) {
    const auto& points = opening.outline.points();
    const bool closed = points.front() == points.back();
    for (const auto& stretch : opening.outline.stretches(closed)) {
        const auto columns = static_cast<uint32_t>(stretch.size() - 1);
        mesh.sheet(columns, 1, [&](uint32_t i, uint32_t j) {
            const Profile::Point& point = stretch[i];
            const float z = j == 0 ? -depth_m : 0.0F;
            return Vertex{{point.position, z}, {point.normal, 0}, {point.along_m, -z}};
        });
    }
}

void addRing(MeshBuilder& mesh, const Ring& ring) {
    MeshBuilder row = mesh.fresh();
    const float middle_radius = ring.radius + 0.5F * ring.height;
    const float width = kPi * middle_radius / static_cast<float>(ring.count);
    for (uint32_t i = 0; i < ring.count; ++i) {
        const float x = width * (static_cast<float>(i) - 0.5F * static_cast<float>(ring.count));
        const bool key = ring.keystone && i == ring.count / 2;
        const float proud = key ? 0.12F * ring.height : 0.0F;
        row.box({x, 0.0F, -ring.half_depth - proud},
                {x + width, ring.height + proud, ring.half_depth + proud}, ring.bevel, ring.omit,
                key ? 0U : kLeft | kRight);
    }
    row.warp([&](glm::vec3 p) {
        const float angle = p.x / middle_radius;
        const float radius = ring.radius + p.y;
        return glm::vec3(radius * std::sin(angle), radius * std::cos(angle), p.z);
    });
    mesh.append(row, glm::mat4(1.0F));
}

} // namespace froxel::builtin_scene
