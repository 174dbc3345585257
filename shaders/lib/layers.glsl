// Layers over a surface: what they are to lights. Loops over lights, shadows and blocks of pixels
// ask here alone; in shaders without FROXEL_LAYERED there is nothing of them.
#ifdef FROXEL_LAYERED
// Lets `s` have layers, which count where the material has them.
void addLayers(Layers layers, inout Surface s) {
    Surface c = makeSurface(s.position_view, layers.coat.normal_view, layers.coat.roughness);
    s.layers.coat = CoatSurface(c.normal_view, c.n_dot_v, c.n_dot_eye, c.alpha2, c.visibility_v,
                                c.shininess, c.lobe);
    s.layers.fibres = false;
    s.layers.round = false;
    s.layers.behind = false;
    if (hasAnisotropy()) {
        s.layers.anisotropy = anisotropySurface(layers.anisotropy, s.normal_view, sqrt(s.alpha2));
        // Elsewhere it is round, and of as much area.
        s.alpha2 = s.layers.anisotropy.alpha_t * s.layers.anisotropy.alpha_b;
    }
    if (hasSheen()) {
        s.layers.sheen = sheenSurface(layers.sheen, s.n_dot_v);
    }
    s.layers.diffuse_transmission = layers.diffuse_transmission;
    s.layers.transmission = 0.0;
    if (hasTransmission()) {
        s.layers.transmission = layers.transmission.strength;
        Surface through =
            makeSurface(s.position_view, s.normal_view, layers.transmission.roughness);
        s.layers.through =
            LobeShape(through.alpha2, through.visibility_v, through.shininess, through.lobe);
    }
    s.layers.shadows_behind = uvec4(0u); // found where lights are looped over
}

// The coat as a surface by itself.
Surface coatOf(Surface s) {
    s.layers.round = true;
    s.normal_view = s.layers.coat.normal_view;
    s.n_dot_v = s.layers.coat.n_dot_v;
    s.n_dot_eye = s.layers.coat.n_dot_eye;
    s.alpha2 = s.layers.coat.alpha2;
    s.visibility_v = s.layers.coat.visibility_v;
    s.shininess = s.layers.coat.shininess;
    s.lobe = s.layers.coat.lobe;
    return s;
}

// The sheen as a surface by itself.
Surface sheenOf(Surface s) {
    s.layers.fibres = true;
    return s;
}

// Whether lights on the surface's other side are seen, scattered or through it.
bool litFromBehind() { return hasDiffuseTransmission() || hasTransmission(); }

// Its other side as a surface by itself, whose eye is mirrored there: so what passes it is what
// facets there would mirror.
Surface behindOf(Surface s) {
    s.layers.round = true;
    s.layers.behind = true;
    s.to_eye_view -= (2.0 * s.n_dot_eye) * s.normal_view;
    s.normal_view = -s.normal_view;
    s.shadows = s.layers.shadows_behind;
    if (hasTransmission()) {
        s.alpha2 = s.layers.through.alpha2;
        s.visibility_v = s.layers.through.visibility_v;
        s.shininess = s.layers.through.shininess;
        s.lobe = s.layers.through.lobe;
    }
    return s;
}

bool isFibres(Surface s) { return hasSheen() && s.layers.fibres; }

// A light's D V of fibres, times 2 pi, as the others' lobes are. Where light is brought to bands
// there are none: the sheen then scatters as matt surfaces do.
float fibresLobe(Surface s, float n_dot_sum, float h2, float facing) {
    float sine2 = max(h2 - n_dot_sum * n_dot_sum, 0.0);
    precise float d = s.layers.sheen.height * lobePower(sine2, h2, s.layers.sheen.power);
    precise float shading = 1.0 + s.layers.sheen.lambda_v + sheenLambda(s.layers.sheen, facing);
    precise float lobe = d / (4.0 * shading * s.n_dot_v * max(facing, 1e-7));
    return lobe;
}

bool isStretched(Surface s) { return hasAnisotropy() && !s.layers.round; }

// As fibresLobe(), of facets of two roughnesses. l: unit.
float stretchedLobe(Surface s, vec3 l, float n_dot_sum, float h2, float facing) {
    AnisotropySurface a = s.layers.anisotropy;
    precise vec2 at_l = vec2(dot(a.tangent_view, l), dot(a.bitangent_view, l));
    precise vec2 at_v =
        vec2(dot(a.tangent_view, s.to_eye_view), dot(a.bitangent_view, s.to_eye_view));
    vec2 alpha = vec2(a.alpha_t, a.alpha_b);
    precise vec3 half_over = vec3((at_l + at_v) / alpha, n_dot_sum);
    precise float k = dot(half_over, half_over) / h2;
    precise float v = facing * length(vec3(alpha * at_v, s.n_dot_v)) +
                      s.n_dot_v * length(vec3(alpha * at_l, facing));
    precise float lobe = 1.0 / (alpha.x * alpha.y * k * k * v);
    return lobe;
}

// As its surroundings see it.
Surface bentByAnisotropy(Surface s) {
    AnisotropySurface a = s.layers.anisotropy;
    float roughness = sqrt(a.alpha_b);
    float even = 1.0 - a.strength * (1.0 - roughness);
    precise vec3 across = s.to_eye_view - a.bitangent_view * dot(a.bitangent_view, s.to_eye_view);
    precise vec3 bent = normalize(mix(across * inversesqrt(max(dot(across, across), 1e-12)),
                                      s.normal_view, (even * even) * (even * even)));
    s.normal_view = bent;
    s.n_dot_eye = dot(bent, s.to_eye_view);
    s.n_dot_v = max(abs(s.n_dot_eye), 1e-4);
    s.alpha2 = a.alpha_b * a.alpha_b;
    return s;
}

bool isBehind(Surface layer) { return litFromBehind() && layer.layers.behind; }

bool scattersLightFromBehind() { return hasDiffuseTransmission(); }

// What comes through the surface of what is behind it, and what it scatters of its own side's.
vec3 withLightFromBehind(Surface s, vec3 scattered, vec3 behind) {
    precise vec3 both = mix(scattered, s.layers.diffuse_transmission.color * behind,
                            s.layers.diffuse_transmission.strength);
    return both;
}

// The share of light that is scattered, of what is neither reflected nor passes the surface.
bool transmits() { return hasTransmission(); }
float scatteredShare(Surface s) { return 1.0 - s.layers.transmission; }

// What a light adds to a layer. Fresnel's term is the eye's, so its two parts are one.
vec3 addLayerLight(LightSum of_layer, vec3 sum) {
    precise vec3 all = sum + (of_layer.specular + of_layer.grazing);
    return all;
}

// Adds a light to each layer of `s`: `add` is the call that adds it to `layer`, in `of_layer`.
#define addToLayers(s, sum, add)                                                                   \
    if (hasCoat()) {                                                                               \
        Surface layer = coatOf(s);                                                                 \
        LightSum of_layer = noLight();                                                             \
        add;                                                                                       \
        sum.layers.coat = addLayerLight(of_layer, sum.layers.coat);                                \
    }                                                                                              \
    if (hasSheen() && !hasLight(kLightBands)) {                                                    \
        Surface layer = sheenOf(s);                                                                \
        LightSum of_layer = noLight();                                                             \
        add;                                                                                       \
        sum.layers.sheen = addLayerLight(of_layer, sum.layers.sheen);                              \
    }                                                                                              \
    if (litFromBehind()) {                                                                         \
        Surface layer = behindOf(s);                                                               \
        LightSum of_layer = noLight();                                                             \
        add;                                                                                       \
        sum.layers.behind += of_layer.diffuse;                                                     \
        sum.layers.behind_edge += of_layer.edge;                                                   \
        if (hasTransmission()) {                                                                   \
            sum.layers.through += of_layer.specular;                                               \
            sum.layers.through_grazing += of_layer.grazing;                                        \
        }                                                                                          \
    }

// What a rim scatters more.
void brightenLayers(float by, inout LightSum sum) {
    sum.layers.behind *= by;
    sum.layers.behind_edge *= by;
}

// Whether a layer may face what the surface below it does not.
bool layersFace(Surface s, vec3 l) { return dot(s.layers.coat.normal_view, l) > 0.0; }

// Faces nothing.
void hideLayers(inout Surface s) { s.layers.coat.normal_view = vec3(0.0); }

// Componentwise, of the surface's normal and its layers'.
vec3 highestNormal(Surface s) {
    vec3 other = litFromBehind() ? -s.normal_view : s.normal_view;
    return max(max(s.normal_view, other), s.layers.coat.normal_view);
}
vec3 lowestNormal(Surface s) {
    vec3 other = litFromBehind() ? -s.normal_view : s.normal_view;
    return min(min(s.normal_view, other), s.layers.coat.normal_view);
}

// Of x: how far a normal is from `normal`, squared; of y: a normal's negated product with `from`.
vec3 largestOfLayers(vec3 own, Surface s, vec3 normal, vec3 from) {
    vec3 turn = s.layers.coat.normal_view - normal;
    own = max(own, vec3(dot(turn, turn), -dot(s.layers.coat.normal_view, from), 0.0));
    if (litFromBehind()) {
        turn = -s.normal_view - normal;
        own = max(own, vec3(dot(turn, turn), dot(s.normal_view, from), 0.0));
    }
    return own;
}
#else
#define addToLayers(s, sum, add)
void brightenLayers(float by, inout LightSum sum) {}
bool isFibres(Surface s) { return false; }
float fibresLobe(Surface s, float n_dot_sum, float h2, float facing) { return 0.0; }
bool isStretched(Surface s) { return false; }
float stretchedLobe(Surface s, vec3 l, float n_dot_sum, float h2, float facing) { return 0.0; }
Surface bentByAnisotropy(Surface s) { return s; }
bool layersFace(Surface s, vec3 l) { return false; }
bool scattersLightFromBehind() { return false; }
bool transmits() { return false; }
float scatteredShare(Surface s) { return 1.0; }
vec3 withLightFromBehind(Surface s, vec3 scattered, vec3 behind) { return scattered; }
void hideLayers(inout Surface s) {}
vec3 highestNormal(Surface s) { return s.normal_view; }
vec3 lowestNormal(Surface s) { return s.normal_view; }
vec3 largestOfLayers(vec3 own, Surface s, vec3 normal, vec3 from) { return own; }
#endif
