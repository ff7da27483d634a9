#include "core/mesh_file/group_maps.h"

#include <algorithm>

namespace oro {

void GroupMaps::begin(std::span<const Triangle> triangles, std::span<const char> is_border) {
    vertices_.clear(), stays_.clear();
    for (const Triangle& triangle : triangles)
        for (const std::uint32_t corner : triangle) {
            if (local_of_[corner] != gone) continue;
            local_of_[corner] = static_cast<std::uint32_t>(vertices_.size());
            vertices_.push_back(corner);
            stays_.push_back(is_border[corner]);
        }
    neighbours_.resize(std::max(neighbours_.size(), vertices_.size()));
    for (std::size_t i = 0; i < vertices_.size(); ++i) neighbours_[i].clear();
    for (const Triangle& triangle : triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = local_of_[triangle[i]];
            for (const std::size_t k : {1U, 2U}) {
                const std::uint32_t to = local_of_[triangle[(i + k) % 3]];
                std::vector<std::uint32_t>& others = neighbours_[from];
                if (std::find(others.begin(), others.end(), to) == others.end()) others.push_back(to);
            }
        }
    way_.assign(vertices_.size(), gone);
}

// An encoder's: by what is left of a vertex's triangles, step by step from those that stay.
void GroupMaps::find_ways(std::span<const Triangle> triangles, std::span<const Left> left) {
    std::vector<std::uint32_t> end(vertices_.size(), gone);
    for (const Left& one : left)
        for (std::size_t i = 0; i < 3; ++i) {
            // A vertex stays where a triangle goes to, even where nothing is left of its own.
            const std::uint32_t there = one.corners[i] < local_of_.size() ? local_of_[one.corners[i]] : gone;
            if (there == gone) continue;
            end[local_of_[triangles[one.number][i]]] = there;
            end[there] = there;
        }
    std::vector<std::uint32_t> reached;
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
        if (end[i] != i && stays_[i] == 0) continue;
        way_[i] = i;
        reached.push_back(i);
    }
    for (std::size_t i = 0; i < reached.size(); ++i)
        for (const std::uint32_t next : neighbours_[reached[i]]) {
            if (way_[next] != gone || end[next] == gone) continue;
            const std::uint32_t here = reached[i];
            if (end[next] != (end[here] == gone ? here : end[here])) continue;
            way_[next] = here;
            reached.push_back(next);
        }
    // What went over vertices of which nothing is left.
    for (std::uint32_t i = 0; i < vertices_.size(); ++i)
        if (way_[i] == gone) way_[i] = end[i];
}

template <class Coder>
void GroupMaps::code_ways(Coder& coder) {
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
        if (stays_[i] != 0) {
            way_[i] = i;
            continue;
        }
        const std::vector<std::uint32_t>& others = neighbours_[i];
        std::size_t moving = 0, vanishing = 0;
        for (const std::uint32_t other : others) {
            if (other >= i) continue;
            moving += way_[other] != other ? 1U : 0U;
            vanishing += way_[other] == gone ? 1U : 0U;
        }
        if (!coder.bit(goes_[std::min<std::size_t>(moving, 3)], way_[i] != i)) {
            way_[i] = i;
            continue;
        }
        if (coder.bit(vanishes_[vanishing > 0 ? 1 : 0], way_[i] == gone)) {
            way_[i] = gone;
            continue;
        }
        const auto rank =
            static_cast<std::uint32_t>(std::find(others.begin(), others.end(), way_[i]) - others.begin());
        const std::uint32_t which = which_.code(coder, rank);
        way_[i] = which < others.size()
                      ? others[which]
                      : coder.uniform(static_cast<std::uint32_t>(vertices_.size()), way_[i]);
    }
}

// False where a way goes in a circle.
bool GroupMaps::end_ways() {
    std::vector<std::uint32_t> steps;
    std::vector<char> is_known(vertices_.size(), 0);
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
        steps.clear();
        std::uint32_t at = i;
        while (at != gone && is_known[at] == 0 && way_[at] != at) {
            if (steps.size() > vertices_.size()) return false;
            steps.push_back(at);
            at = way_[at];
        }
        const std::uint32_t end = at == gone ? gone : way_[at];
        for (const std::uint32_t step : steps) way_[step] = end, is_known[step] = 1;
        is_known[i] = 1;
    }
    return true;
}

void GroupMaps::apply(std::span<const Triangle> triangles, std::vector<Left>& left) const {
    left.clear();
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        Left one{i, {}, 0};
        bool is_there = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t end = way_[local_of_[triangles[i][k]]];
            is_there = is_there && end != gone;
            if (is_there) one.corners[k] = vertices_[end];
        }
        const auto& [a, b, c] = one.corners;
        if (is_there && a != b && b != c && c != a) left.push_back(one);
    }
}

template <class Coder>
void GroupMaps::code_clusters(Coder& coder, std::uint32_t made, std::vector<Left>& left,
                              std::span<const Left> source) {
    // Of each vertex the cluster of the last triangle that has it; the first cluster where there is none.
    std::vector<std::uint32_t> last(vertices_.size(), gone);
    for (std::size_t i = 0; i < left.size(); ++i) {
        std::array<std::uint32_t, 3> near{};
        for (std::size_t k = 0; k < 3; ++k) near[k] = last[local_of_[left[i].corners[k]]];
        std::uint32_t guess = near[0] == near[1] || near[0] == near[2] ? near[0] : near[1];
        for (const std::uint32_t one : near)
            if (guess == gone) guess = one;
        std::uint32_t cluster = 0;
        if constexpr (Coder::writes) cluster = source[i].cluster;
        if (guess == gone || !coder.bit(same_cluster_, cluster == guess))
            cluster = coder.uniform(made, cluster);
        else
            cluster = guess;
        left[i].cluster = cluster;
        for (const std::uint32_t corner : left[i].corners) last[local_of_[corner]] = cluster;
    }
}

template <class Coder>
bool GroupMaps::code(Coder& coder, std::span<const Triangle> triangles, std::span<const char> is_border,
                     std::uint32_t made, std::vector<Left>& left) {
    begin(triangles, is_border);
    std::vector<Left> source;
    if constexpr (Coder::writes) {
        find_ways(triangles, left);
        source = left;
    }
    code_ways(coder);
    bool is_right = end_ways();
    if (is_right) apply(triangles, left);
    if constexpr (Coder::writes)
        is_right = is_right && std::equal(left.begin(), left.end(), source.begin(), source.end(),
                                          [](const Left& a, const Left& b) {
                                              return a.number == b.number && a.corners == b.corners;
                                          });
    is_right = is_right && (made > 0 || left.empty());
    if (is_right) code_clusters(coder, made, left, source);
    for (const std::uint32_t vertex : vertices_) local_of_[vertex] = gone;
    return is_right;
}

template bool GroupMaps::code(RangeEncoder&, std::span<const Triangle>, std::span<const char>, std::uint32_t,
                              std::vector<Left>&);
template bool GroupMaps::code(RangeDecoder&, std::span<const Triangle>, std::span<const char>, std::uint32_t,
                              std::vector<Left>&);

}  // namespace oro
