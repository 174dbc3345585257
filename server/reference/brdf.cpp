#include "reference/brdf.h"

#include "core/lobes.h"
#include "reference/around.h"
#include "reference/toon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace froxel::reference {

double cosineToEye(const Surface& s) {
    return std::max(std::abs(glm::dot(s.normal, s.to_eye)), 1e-4);
}

namespace {

constexpr double kInvPi = std::numbers::inv_pi;

double greatest(const glm::dvec3& color) {
    return std::max({color.x, color.y, color.z});
}

bool hasFilm(const Surface& s, const Model& model) {
    return s.film.strength > 0 && model.shading != settings::ShadingModel::kLambert;
}

glm::dvec3 ambient(const Surface& s, const Model& model, const Lights& lights) {
    const double up = 0.5 + 0.5 * s.normal.y;
    const glm::dvec3 incoming = glm::mix(lights.ground, lights.sky, up);
    const glm::dvec3 matt =
        scattered(s, model, incoming, glm::mix(lights.ground, lights.sky, 1 - up));
    if (model.shading == settings::ShadingModel::kLambert) {
        return matt * s.occlusion;
    }
    // Scaled so that a usual dielectric returns its base colour and its f0.
    const glm::dvec3 dielectric =
        matt * ((1 - greatest(s.dielectric_f0)) / 0.96) + s.dielectric_f0 * incoming;
    glm::dvec3 all = glm::mix(dielectric, s.base_color * incoming, s.metallic);
    if (hasFilm(s, model)) {
        const glm::dvec3 of_dielectric = filmReflects(s.film, s.dielectric_f0, cosineToEye(s));
        const glm::dvec3 filmed =
            glm::mix(matt * ((1 - greatest(of_dielectric)) / 0.96) + of_dielectric * incoming,
                     filmReflects(s.film, s.base_color, cosineToEye(s)) * incoming, s.metallic);
        all = glm::mix(all, filmed, s.film.strength);
    }
    return all * s.occlusion;
}

double alphaOf(double roughness) {
    return std::pow(std::max(roughness, kLeastRoughness), 2);
}

// D V of a surface's highlight.
double lobeOf(const Model& model,
              const glm::dvec3& normal,
              double roughness,
              const glm::dvec3& to_eye,
              const glm::dvec3& half,
              double facing) {
    const double alpha2 = std::pow(alphaOf(roughness), 2);
    const double n_dot_h = glm::dot(normal, half);
    return model.shading == settings::ShadingModel::kBlinnPhong
               ? lobes::blinnPhong(n_dot_h, alpha2)
               : lobes::distribution(n_dot_h, alpha2) *
                     lobes::visibility(facing, std::abs(glm::dot(normal, to_eye)), alpha2);
}

// D V of a surface's own highlight, below its coat.
double baseLobe(const Surface& s, const Model& model, const glm::dvec3& to_light, double facing) {
    if (isStretched(s, model)) {
        return AnisotropyAxes(s.anisotropy, s.normal, alphaOf(s.roughness))
            .lobe(s.normal, to_light, s.to_eye);
    }
    const glm::dvec3 sum = to_light + s.to_eye;
    const double length = glm::length(sum);
    return lobeOf(model, s.normal, s.roughness, s.to_eye, length > 0 ? sum / length : glm::dvec3(0),
                  facing);
}

// What a surface scatters, as a multiple of what one that is no rim does.
double rimShare(const Surface& s, const Model& model) {
    return std::abs(glm::dot(s.normal, s.to_eye)) < model.rim_width ? 1 + model.rim : 1;
}

bool hasSheen(const Surface& s, const Model& model) {
    return s.sheen.color != glm::dvec3(0) && model.shading != settings::ShadingModel::kLambert;
}

// What a coat reflects of the ambient light, of a share of 1.
glm::dvec3 coatAmbient(const Surface& s, const Lights& lights) {
    return glm::mix(lights.ground, lights.sky, 0.5 + 0.5 * s.coat.normal.y) * s.occlusion;
}

} // namespace

glm::dvec3
scattered(const Surface& s, const Model& model, const glm::dvec3& ahead, const glm::dvec3& behind) {
    const glm::dvec3 plain = s.base_color * ahead;
    const glm::dvec3 all = model.shading == settings::ShadingModel::kLambert
                               ? plain
                               : glm::mix(plain, s.diffuse_transmission.color * behind,
                                          s.diffuse_transmission.strength);
    return all * (1 - s.transmission.strength);
}

bool isStretched(const Surface& s, const Model& model) {
    return s.anisotropy.strength > 0 && s.anisotropy.direction != glm::dvec3(0) &&
           model.shading == settings::ShadingModel::kPbr;
}

// fresnel_coat() of KHR_materials_clearcoat, whose index of refraction is 1.5.
double coatShare(const Surface& s, const Model& model) {
    if (model.shading == settings::ShadingModel::kLambert) {
        return 0;
    }
    const double n_dot_v = std::abs(glm::dot(s.coat.normal, s.to_eye));
    return s.coat.strength * (0.04 + 0.96 * lobes::fifth(std::max(0.0, 1 - n_dot_v)));
}

namespace {

double ramped(const Model& model, double facing) {
    return model.ramp != nullptr ? toonRamp(*model.ramp, facing) : facing;
}

glm::dvec3 halfOf(const glm::dvec3& a, const glm::dvec3& b) {
    const double length = glm::length(a + b);
    return length > 0 ? (a + b) / length : glm::dvec3(0);
}

// The eye as the surface's other side sees it: what passes the surface is what that would mirror.
glm::dvec3 mirroredEye(const Surface& s) {
    return s.to_eye - 2.0 * glm::dot(s.normal, s.to_eye) * s.normal;
}

// A lobe of the other side, times its cosine, as an eye that is mirrored there sees it.
double throughLobe(const Surface& s,
                   const Model& model,
                   const glm::dvec3& mirrored,
                   const glm::dvec3& to_light) {
    const double facing = -glm::dot(s.normal, to_light);
    return facing > 0 && s.transmission.strength > 0
               ? facing * lobeOf(model, -s.normal, s.transmission.roughness, mirrored,
                                 halfOf(to_light, mirrored), facing)
               : 0;
}

// What passes a dielectric of what arrives from behind.
glm::dvec3 passing(const Surface& s, double lobe) {
    return s.base_color * s.transmission.left * (s.transmission.strength * lobe);
}

// What a surface that is all under its film sends: what it scatters and a lobe, both before
// Fresnel's term.
glm::dvec3 underFilm(const Surface& s, const glm::dvec3& matt, const glm::dvec3& lobe) {
    const glm::dvec3 of_dielectric = filmReflects(s.film, s.dielectric_f0, cosineToEye(s));
    const glm::dvec3 of_metal = filmReflects(s.film, s.base_color, cosineToEye(s));
    return matt * ((1 - greatest(of_dielectric)) * (1 - s.metallic)) +
           glm::mix(of_dielectric, of_metal, s.metallic) * lobe;
}

// What one light, in parts, sends to a surface, before it is brought to its bands.
class Banded {
  public:
    Banded(const Surface& surface, const Model& model) : s_(surface), model_(model) {}

    // Of unit direction; irradiance on a plane that faces it.
    void add(const glm::dvec3& to_light, double irradiance) {
        const glm::dvec3 sum = to_light + s_.to_eye;
        const double length = glm::length(sum);
        const glm::dvec3 half = length > 0 ? sum / length : glm::dvec3(0);
        whole_ += irradiance;
        addTo(base_, s_.normal, to_light, irradiance,
              [&](double facing) { return baseLobe(s_, model_, to_light, facing); });
        const glm::dvec3 mirrored = mirroredEye(s_);
        addTo(behind_, -s_.normal, to_light, irradiance,
              [&](double facing) { return throughLobe(s_, model_, mirrored, to_light) / facing; });
        addTo(coat_, s_.coat.normal, to_light, irradiance, [&](double facing) {
            return lobeOf(model_, s_.coat.normal, s_.coat.roughness, s_.to_eye, half, facing);
        });
    }

    // Towards the eye, of bands about `middle`.
    [[nodiscard]] glm::dvec3 reflected(double middle) const {
        const double light = toonBand(model_.bands, base_.scattered, middle) / std::numbers::pi;
        const double behind = toonBand(model_.bands, behind_.scattered, middle) / std::numbers::pi;
        const glm::dvec3 matt =
            rimShare(s_, model_) * scattered(s_, model_, glm::dvec3(light), glm::dvec3(behind));
        if (model_.shading == settings::ShadingModel::kLambert) {
            return matt;
        }
        const glm::dvec3 f0 = glm::mix(s_.dielectric_f0, s_.base_color, s_.metallic);
        const double shine = gloss(base_, baseAlpha()) * light;
        glm::dvec3 below =
            matt * ((1 - greatest(s_.dielectric_f0)) * (1 - s_.metallic)) + f0 * shine;
        const glm::dvec3 through =
            (1 - s_.metallic) *
            passing(s_, gloss(behind_, alphaOf(s_.transmission.roughness)) * behind);
        below += through * (1 - greatest(s_.dielectric_f0));
        if (hasFilm(s_, model_)) {
            const double enters =
                1 - greatest(filmReflects(s_.film, s_.dielectric_f0, cosineToEye(s_)));
            below = glm::mix(below, underFilm(s_, matt, glm::dvec3(shine)) + through * enters,
                             s_.film.strength);
        }
        if (hasSheen(s_, model_)) { // its fibres scatter as matt surfaces do
            below = below * belowSheen(s_.sheen, cosineToEye(s_)) +
                    sheenReflectance(s_.sheen, cosineToEye(s_)) * (rimShare(s_, model_) * light);
        }
        const double share = coatShare(s_, model_);
        return share > 0
                   ? below * (1 - share) + share * gloss(coat_, alphaOf(s_.coat.roughness)) *
                                               toonBand(model_.bands, coat_.scattered, middle) /
                                               std::numbers::pi
                   : below;
    }

  private:
    struct Layer {
        double scattered = 0; // through the ramp
        double lobe = 0;      // times pi
    };
    // lobe: D V, of n.l.
    template <class Lobe>
    void addTo(Layer& layer,
               const glm::dvec3& normal,
               const glm::dvec3& to_light,
               double irradiance,
               const Lobe& lobe) const {
        const double facing = std::max(0.0, glm::dot(normal, to_light));
        layer.scattered += irradiance * ramped(model_, facing);
        if (facing > 0 && model_.shading != settings::ShadingModel::kLambert) {
            layer.lobe += irradiance * facing * std::numbers::pi * lobe(facing);
        }
    }
    // alpha: of a round lobe of as much area
    [[nodiscard]] double gloss(const Layer& layer, double alpha) const {
        const double gloss = toonGloss(alpha);
        return layer.lobe >= gloss * whole_ ? gloss : 0;
    }

    [[nodiscard]] double baseAlpha() const {
        const double alpha = alphaOf(s_.roughness);
        return isStretched(s_, model_)
                   ? std::sqrt(alpha * AnisotropyAxes(s_.anisotropy, s_.normal, alpha).alpha_t)
                   : alpha;
    }

    const Surface& s_;
    const Model& model_;
    double whole_ = 0;
    Layer base_;
    Layer behind_;
    Layer coat_;
};

} // namespace

namespace {

double edgeOf(const glm::dvec3& to_eye, const glm::dvec3& to_light) {
    const glm::dvec3 half = halfOf(to_light, to_eye);
    return lobes::fifth(std::max(0.0, 1 - std::abs(glm::dot(to_eye, half))));
}

glm::dvec3 dielectricAt(const Surface& s, double edge) {
    return glm::mix(s.dielectric_f0, glm::dvec3(s.dielectric_f90), edge);
}

} // namespace

glm::dvec3 reflected(const Surface& s, const Model& model, const glm::dvec3& to_light) {
    const double facing = std::max(0.0, glm::dot(s.normal, to_light));
    const double ahead = rimShare(s, model) * ramped(model, facing) * kInvPi;
    const double behind =
        rimShare(s, model) * kInvPi * ramped(model, std::max(0.0, -glm::dot(s.normal, to_light)));
    if (model.shading == settings::ShadingModel::kLambert) {
        return s.base_color * (ahead * (1 - s.transmission.strength));
    }
    const glm::dvec3 half = halfOf(to_light, s.to_eye);
    const double edge = edgeOf(s.to_eye, to_light);
    const glm::dvec3 of_dielectric = dielectricAt(s, edge);
    const glm::dvec3 of_metal = s.base_color + (1.0 - s.base_color) * edge;
    // KHR_materials_diffuse_transmission leaves Fresnel's term open: an eye mirrored to the other
    // side makes the way there and back the same.
    const glm::dvec3 mirrored = mirroredEye(s);
    const double enters_behind = 1 - greatest(dielectricAt(s, edgeOf(mirrored, to_light)));
    // Appendix B: both models are whole, and metalness mixes what they give. A dielectric scatters
    // what the strongest reflected channel leaves (KHR_materials_specular).
    glm::dvec3 out =
        (1 - s.metallic) * scattered(s, model, glm::dvec3((1 - greatest(of_dielectric)) * ahead),
                                     glm::dvec3(enters_behind * behind));
    const glm::dvec3 through =
        (1 - s.metallic) * passing(s, throughLobe(s, model, mirrored, to_light));
    out += through * enters_behind;
    const double lobe = facing > 0 ? facing * baseLobe(s, model, to_light, facing) : 0;
    out += glm::mix(of_dielectric, of_metal, s.metallic) * lobe;
    if (hasFilm(s, model)) {
        const glm::dvec3 matt = scattered(s, model, glm::dvec3(ahead), glm::dvec3(behind));
        const double enters = 1 - greatest(filmReflects(s.film, s.dielectric_f0, cosineToEye(s)));
        out =
            glm::mix(out, underFilm(s, matt, glm::dvec3(lobe)) + through * enters, s.film.strength);
    }
    if (hasSheen(s, model)) {
        const double n_dot_v = cosineToEye(s);
        const double fibres =
            facing > 0 ? sheenLobe(glm::dot(s.normal, half), facing, n_dot_v, s.sheen.roughness)
                       : 0;
        out = out * belowSheen(s.sheen, n_dot_v) +
              sheenStrength(s.sheen, n_dot_v) * (facing * fibres);
    }
    const double share = coatShare(s, model);
    if (share > 0) {
        const double coat_facing = std::max(0.0, glm::dot(s.coat.normal, to_light));
        const double coat = coat_facing > 0 ? lobeOf(model, s.coat.normal, s.coat.roughness,
                                                     s.to_eye, half, coat_facing)
                                            : 0;
        out = out * (1 - share) + share * coat_facing * coat;
    }
    return out;
}

double attenuation(const PointLight& light, const glm::dvec3& to_light) {
    const double d2 = glm::dot(to_light, to_light);
    if (!(d2 < light.radius2) || d2 == 0) {
        return 0; // a light on the surface has no direction
    }
    const double x = d2 / light.radius2;
    const double window = 1 - x * x;
    const double along = -glm::dot(light.direction, to_light) / std::sqrt(d2);
    const double share = std::clamp(along * light.cone_scale + light.cone_offset, 0.0, 1.0);
    const double floor2 = light.rectangle ? 0 : light.nearest_m * light.nearest_m;
    return window * window / std::max(d2, floor2) * share * share;
}

// As many points of a rectangle, each a small light of the same radiance; nothing of it lies nearer
// to a surface than they lie to one another, or the sum is coarse.
glm::dvec3 fromRectangle(const Surface& s, const Model& model, const PointLight& light) {
    const glm::dvec3 to_centre = light.position - s.position;
    const double window = attenuation(light, to_centre) * glm::dot(to_centre, to_centre);
    glm::dvec3 sum(0);
    Banded banded(s, model);
    if (window > 0) {
        light.eachPart(s.position, [&](const glm::dvec3& part, double share) {
            const glm::dvec3 to_part = part - s.position;
            const double d = glm::length(to_part);
            const double facing = -glm::dot(light.direction, to_part) / d;
            if (facing > 0 && model.bands > 0) {
                banded.add(to_part / d, facing * share * window / (d * d));
            } else if (facing > 0) {
                sum += reflected(s, model, to_part / d) * (facing * share / (d * d));
            }
        });
    }
    return light.color * (model.bands > 0 ? banded.reflected(light.bands_middle) : sum * window);
}

// As much irradiance on a plane that faces it, from a unit direction.
glm::dvec3 fromDirection(const Surface& s,
                         const Model& model,
                         const glm::dvec3& to_light,
                         double irradiance,
                         double middle) {
    if (model.bands == 0) {
        return reflected(s, model, to_light) * irradiance;
    }
    Banded banded(s, model);
    banded.add(to_light, irradiance);
    return banded.reflected(middle);
}

namespace {

// What is seen through a surface, by Fresnel's term of the eye's angle: of its lobe where light
// comes from around, else of its normal.
glm::dvec3
transmitted(const Surface& s, const Model& model, const Lights& lights, const glm::dvec3& seen) {
    const glm::dvec3 all = passing(s, 1) * seen;
    if (model.shading == settings::ShadingModel::kLambert) {
        return all;
    }
    const double film =
        1 - greatest(lights.around ? filmedAround(s)
                                   : filmReflects(s.film, s.dielectric_f0, cosineToEye(s)));
    const double plain =
        1 - greatest(lights.around ? dielectricAround(s)
                                   : dielectricAt(s, lobes::fifth(1 - cosineToEye(s))));
    return all *
           ((1 - s.metallic) * std::lerp(plain, film, hasFilm(s, model) ? s.film.strength : 0));
}

} // namespace

glm::dvec3 radiance(const Surface& s,
                    const Model& model,
                    const Lights& lights,
                    const Open& open,
                    const glm::dvec3& seen) {
    if (s.unlit) {
        return s.base_color;
    }
    glm::dvec3 sum(0);
    for (const PointLight& light : lights.points) {
        const glm::dvec3 to_light = light.position - s.position;
        const double d2 = glm::dot(to_light, to_light);
        if (light.rectangle) {
            sum += fromRectangle(s, model, light);
        } else if (d2 < light.radius2) { // most lights are too far away
            const double share = attenuation(light, to_light);
            const double passes =
                share > 0 && light.shadowed ? open(s.position, light.position) : 1;
            if (share > 0 && passes > 0) {
                sum += light.color * fromDirection(s, model, to_light / std::sqrt(d2),
                                                   share * passes, light.bands_middle);
            }
        }
    }
    for (const DirectionalLight& light : lights.directionals) {
        sum += light.color * fromDirection(s, model, -light.direction, 1, 0);
    }
    glm::dvec3 all_around =
        lights.around ? fromAround(s, model, *lights.around) : ambient(s, model, lights);
    if (s.transmission.strength > 0) {
        all_around += transmitted(s, model, lights, seen);
    }
    if (hasSheen(s, model)) {
        const double n_dot_v = cosineToEye(s);
        const glm::dvec3 matt = lights.around
                                    ? lights.around->matt.at(s.normal)
                                    : glm::mix(lights.ground, lights.sky, 0.5 + 0.5 * s.normal.y);
        all_around = all_around * belowSheen(s.sheen, n_dot_v) +
                     sheenReflectance(s.sheen, n_dot_v) * matt * s.occlusion;
    }
    const double share = coatShare(s, model);
    if (share > 0) {
        sum += share * (lights.around ? coatAround(s, *lights.around) : coatAmbient(s, lights));
    }
    return sum + (all_around + s.emissive) * (1 - share);
}

} // namespace froxel::reference
