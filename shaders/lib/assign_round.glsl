// The two operations of light assignment that Vulkan does not say how to round: correctly, here.
// assign_probe.comp finds out whether a device does.

double assignDivide(double a, double b) {
    precise double quotient = a / b;
    return quotient;
}

double assignSqrt(double a) {
    precise double root = sqrt(a);
    return root;
}
