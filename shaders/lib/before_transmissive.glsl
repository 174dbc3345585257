// Blended surfaces behind the nearest surface that transmits light are drawn before it, all others
// after it. Where there is none its depth is 0, and nothing is behind.
bool drawnNow(vec4 fragment) {
    if (hasOutput(kOutputBehindTransmissive) || hasOutput(kOutputBeforeTransmissive)) {
        bool behind = fragment.z < texelFetch(transmissive_depth, ivec2(fragment.xy), 0).r;
        return behind == hasOutput(kOutputBehindTransmissive);
    }
    return true;
}
