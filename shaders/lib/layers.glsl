// Layers over a surface: what they are to lights. Loops over lights, shadows and blocks of pixels
// ask here alone; in shaders without FROXEL_LAYERED there is nothing of them.
#ifdef FROXEL_LAYERED
// Lets `s` have a coat: of a normal and roughness that count where the material has one.
void addCoatSurface(Coat coat, inout Surface s) {
    Surface c = makeSurface(s.position_view, coat.normal_view, coat.roughness);
    s.coat = CoatSurface(c.normal_view, c.n_dot_v, c.n_dot_eye, c.alpha2, c.visibility_v,
                         c.shininess, c.lobe);
}

// The coat as a surface by itself.
Surface coatOf(Surface s) {
    s.normal_view = s.coat.normal_view;
    s.n_dot_v = s.coat.n_dot_v;
    s.n_dot_eye = s.coat.n_dot_eye;
    s.alpha2 = s.coat.alpha2;
    s.visibility_v = s.coat.visibility_v;
    s.shininess = s.coat.shininess;
    s.lobe = s.coat.lobe;
    return s;
}

// of_coat: what a light adds to coatOf(). Fresnel's term is the eye's, so its two parts are one.
void addCoatLight(LightSum of_coat, inout LightSum sum) {
    precise vec3 coat = sum.coat + (of_coat.specular + of_coat.grazing);
    sum.coat = coat;
}

// Adds a light to each layer of `s`: `add` is the call that adds it to `layer`, in `of_layer`.
#define addToLayers(s, sum, add)                                                                   \
    if (hasCoat()) {                                                                               \
        Surface layer = coatOf(s);                                                                 \
        LightSum of_layer = noLight();                                                             \
        add;                                                                                       \
        addCoatLight(of_layer, sum);                                                               \
    }

// Whether a layer may face what the surface below it does not.
bool layersFace(Surface s, vec3 l) { return dot(s.coat.normal_view, l) > 0.0; }

// Faces nothing.
void hideLayers(inout Surface s) { s.coat.normal_view = vec3(0.0); }

// Componentwise, of the surface's normal and its layers'.
vec3 highestNormal(Surface s) { return max(s.normal_view, s.coat.normal_view); }
vec3 lowestNormal(Surface s) { return min(s.normal_view, s.coat.normal_view); }

// Of x: how far a normal is from `normal`, squared; of y: a normal's negated product with `from`.
vec3 largestOfLayers(vec3 own, Surface s, vec3 normal, vec3 from) {
    vec3 turn = s.coat.normal_view - normal;
    return max(own, vec3(dot(turn, turn), -dot(s.coat.normal_view, from), 0.0));
}
#else
#define addToLayers(s, sum, add)
bool layersFace(Surface s, vec3 l) { return false; }
void hideLayers(inout Surface s) {}
vec3 highestNormal(Surface s) { return s.normal_view; }
vec3 lowestNormal(Surface s) { return s.normal_view; }
vec3 largestOfLayers(vec3 own, Surface s, vec3 normal, vec3 from) { return own; }
#endif
