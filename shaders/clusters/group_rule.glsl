// The rule of every cut: whether a group of clusters stands for what it was made of. Compiled as GLSL for the GPU and as C++ by
// core/cluster_frame/group_rule.cpp. It adds and multiplies, and does nothing else that a device may round in its own way; `precise`,
// so that both give the same answer to the bit. Needs shared.h.

// Stands where its error, projected from the nearest place that it may have, is at most tau: one of the two bounds of
// projected_error_px (shaders/choose/levels.glsl), k e s^2 / (d - r - e s) and k e sqrt(1 + t^2) / (z - e), is. Both without a division,
// the second in squares. tau shrinks from a level to the next, by more than all of it rounds (AskedGroup.radius grows alike): where a
// group stands all below it stand.
ORO_FUNCTION bool group_stands(AskedGroup group, CutRule rule) {
    if (rule.level != no_cut_level) return group.level <= rule.level;
    if (group.error <= 0.0f) return true;
    ORO_PRECISE float tau_px = rule.tau_px * (1.0f - 2.0e-6f * float(group.level + 1u));
    ORO_PRECISE float stretched = group.error * rule.stretch;
    ORO_PRECISE float right = (group.radius + stretched) * tau_px + rule.pixels_per_tangent * stretched * rule.stretch;
    ORO_PRECISE float left = group.distance * tau_px;
    if (left >= right) return true;
    ORO_PRECISE float z = group.along - group.radius;
    ORO_PRECISE float clear = z - group.error;
    if (clear <= 0.0f) return false;
    ORO_PRECISE float across = min(group.across + group.radius, rule.corner_tangent * z);
    ORO_PRECISE float moved = rule.pixels_per_tangent * group.error;
    ORO_PRECISE float allowed = tau_px * clear * z;
    ORO_PRECISE float moved_squared = moved * moved * (z * z + across * across);
    ORO_PRECISE float allowed_squared = allowed * allowed;
    return moved_squared <= allowed_squared;
}
