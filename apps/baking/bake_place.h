// Where a region is baked whose file shall lie on a network: on this machine first, for a bake writes in many
// places of its file, and goes on where it was broken off.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// A file to be baked: of this machine it is baked where it shall be, of a network in a folder of the user's
// cache that belongs to that path alone, and copied from there.
class BakePlace {
  public:
    // Makes the folder if need be. Errors: a path on a network where those are not allowed, of another name
    // than .oro, or that is there already (without `overwrite`); no folder for caches.
    static Result<BakePlace> of(const std::string& out, bool overwrite);

    // Where to bake, on this machine.
    [[nodiscard]] const std::string& path() const { return path_; }
    // The name that a file of the bake, path() or one beside it, has where it goes.
    [[nodiscard]] std::string shown(const std::string& file) const;
    // Of a network: gets what is there of parts, which others have baked, to be joined; or with `part`
    // ("2of4") what is there of that one, and windows of clusters, to be gone on with.
    Result<void> fetch_parts(const std::string& part = "") const;
    // Of a network: copies the parts that are beside path() there, and removes all that is here.
    Result<void> send_parts() const;
    // Of a network: copies the baked file there, removes the parts that are there, and all that is here.
    // Where that fails the baked file stays here, and the error says where.
    Result<void> send_baked() const;

  private:
    [[nodiscard]] bool is_on_network() const { return path_ != out_; }
    void clear() const;
    std::string out_;
    std::string path_;
};

}  // namespace oro
