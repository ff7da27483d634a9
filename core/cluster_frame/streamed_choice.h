// Which clusters a frame draws that does not wait: the finest cut of those that are here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/cluster_frame/cluster_choice.h"
#include "core/cluster_frame/cluster_offer.h"
#include "core/cluster_frame/shown_clusters.h"

namespace oro {

struct StreamedChoice {
    ClusterChoice drawn;  // all of them are here
    ClusterOffer offer;   // that the GPU makes the same of
    // What should come, coarsest first, as groups need not be asked for before those above them are known.
    // Those that are hidden, as far as the last frame told, come after all others, in the same order.
    std::vector<std::uint32_t> groups_wanted;        // to be read
    std::vector<std::uint32_t> clusters_wanted;      // to be here, and to stay; as many as there is room for
    std::size_t groups_hidden{}, clusters_hidden{};  // so many
    // Of clusters_wanted, in its order, those that are not here; the last so many are hidden.
    std::vector<std::uint32_t> clusters_to_come;
    std::size_t to_come_hidden{};
    std::size_t missing{};       // groups and clusters that the cut lacks; 0: it is that of choose_clusters()
    std::size_t without_room{};  // clusters that the cut has too many for the room: a coarser one is drawn
};

// What a choice says of a cut that lacks something, though there is room for it: a coarser one that is here,
// or nothing, for another surface is drawn in its place.
enum class LackingCut { is_drawn, is_left_out };

// Whether a cluster is on the GPU.
using IsClusterHere = std::function<bool(std::uint32_t cluster)>;

// What choices among one region's clusters keep from one to the next: room, so that none is made anew for
// each frame. With one that is kept the choice is that with a new one. For one choice at a time.
class StreamedChoiceMemory {
  public:
    StreamedChoiceMemory();
    StreamedChoiceMemory(StreamedChoiceMemory&&) noexcept;
    StreamedChoiceMemory& operator=(StreamedChoiceMemory&&) noexcept;
    ~StreamedChoiceMemory();

    struct Kept;
    [[nodiscard]] Kept& kept() { return *kept_; }

  private:
    std::unique_ptr<Kept> kept_;
};

// A group gives way to what it uses where the rule says so, where all of that is here that would then be
// drawn and may be seen, and where each group gives way that uses what it made. Of all sets of groups with
// these properties it is the largest; there is one, as two such sets together are one. So each place is
// covered once, whatever is here, as long as the coarsest clusters (roots()) are.
//
// Reads nothing: what nobody has read is wanted. Wanted beside the cut are the clusters above it, so that
// there is something to go back to when the eye moves; of these the coarsest, as far as there is room.
// room: clusters that the GPU may hold beside the roots. shown: by the last frame; what comes in the place of
// clusters that it hid is hidden, and comes last. It changes nothing else. memory: null: of this choice
// alone. Where a cut that lacks something is left out, what is drawn and offered of it stays empty. Errors:
// damage.
Result<StreamedChoice> select_resident_cut(RegionClusters& clusters, const ClusterView& view,
                                           std::size_t room, const IsClusterHere& is_here,
                                           const ShownClusters& shown = {},
                                           StreamedChoiceMemory* memory = nullptr,
                                           LackingCut lacking = LackingCut::is_drawn);

}  // namespace oro
