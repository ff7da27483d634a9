// Sums, products and roots of doubles that have the bits of the processor's. What is exact to the bit stands in functions of values
// alone: glslang 12 does not survive a precise sum of what it reads through an address.

double difference(double a, double b) {
    precise double all = a - b;
    return all;
}
dvec3 difference(dvec3 a, dvec3 b) {
    precise dvec3 all = a - b;
    return all;
}
double sum(double a, double b) {
    precise double all = a + b;
    return all;
}
double product(double a, double b) {
    precise double all = a * b;
    return all;
}

// Numbers as sums of two doubles: 106 bits. Source: T. J. Dekker, A floating-point technique for extending the available
// precision, Numerische Mathematik 18, 1971.
dvec2 sum_of(double a, double b) {
    precise double sum = a + b;
    precise double part = sum - a;
    precise double rest = (a - (sum - part)) + (b - part);
    return dvec2(sum, rest);
}
dvec2 product_of(double a, double b) {
    precise double high = a * b;
    precise double a_split = a * 134217729.0lf, b_split = b * 134217729.0lf;
    precise double a_high = a_split - (a_split - a), b_high = b_split - (b_split - b);
    precise double a_low = a - a_high, b_low = b - b_high;
    precise double low = ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low;
    return dvec2(high, low);
}

dvec3 turned(dvec3 x, dvec3 y, dvec3 z, dvec3 place) {
    precise dvec3 all = x * place.x + y * place.y + z * place.z;
    return all;
}
double along(dvec3 normal, dvec3 place) {
    precise dvec3 parts = normal * place;
    precise double sum = parts.x + parts.y + parts.z;
    return sum;
}
