// Which place among the emitted triangles each drawn triangle of a mesh workgroup takes: their order stays. Invocation `lane` looks at triangle
// lane + each * (size of the workgroup). First begin_slots(); a barrier; then note() for all triangles, those past the last one as not
// drawn; a barrier; then the others.
#ifdef HALVES
// The workgroup is one whole subgroup: a ballot for each turn tells all of it.
uvec4 drawn_in_turn[triangles_each];

void begin_slots() {}
void note(uint each, uint i, uint triangles, bool drawn) { drawn_in_turn[each] = subgroupBallot(drawn); }
uint slots_taken(uint triangles) {
    uint taken = 0u;
    for (uint each = 0u; each < triangles_each; ++each) taken += subgroupBallotBitCount(drawn_in_turn[each]);
    return taken;
}
uint slot_of(uint each, uint i) {
    uint before = subgroupBallotExclusiveBitCount(drawn_in_turn[each]);
    for (uint turn = 0u; turn < each; ++turn) before += subgroupBallotBitCount(drawn_in_turn[turn]);
    return before;
}
#else
// A bit for each triangle that is not drawn. They are few, and most groups have none: bits of those that are drawn would be set one after
// the other, for all are in the same words.
shared uint missing[group_triangles / 32u];
shared uint missing_count;

void begin_slots() {
    for (uint i = gl_LocalInvocationIndex; i < missing.length(); i += gl_WorkGroupSize.x) missing[i] = 0u;
    if (gl_LocalInvocationIndex == 0u) missing_count = 0u;
}
void note(uint each, uint i, uint triangles, bool drawn) {
    if (drawn || i >= triangles) return;
    atomicOr(missing[i / 32u], 1u << (i % 32u));
    atomicAdd(missing_count, 1u);
}
uint slots_taken(uint triangles) { return triangles - missing_count; }
uint slot_of(uint each, uint i) {
    if (missing_count == 0u) return i;
    uint drawn = i;
    for (uint word = 0u; word < i / 32u; ++word) drawn -= uint(bitCount(missing[word]));
    return drawn - (i % 32u == 0u ? 0u : uint(bitCount(missing[i / 32u] & ((1u << (i % 32u)) - 1u))));
}
#endif
