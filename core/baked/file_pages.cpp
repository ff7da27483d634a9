#include "core/baked/file_pages.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <list>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <utility>

#include "core/base/parallel.h"
#include "core/lod/ground_means.h"
#include "core/terrain/page_on_net.h"

namespace oro {
namespace {

constexpr std::size_t records_kept = 65536;  // 40 MB

// N for what is coloured by H.
UndulationField drawn_undulation(const RegionOutline& outline) {
    if (!outline.grid.net) return outline.undulation;
    HeightField field;
    field.grid = outline.grid;
    field.undulation = outline.undulation;
    return oro::drawn_undulation(field);
}

class FilePages : public RegionPages {
  public:
    explicit FilePages(std::shared_ptr<const RegionFile> file)
        : RegionPages({file->outline().grid, drawn_undulation(file->outline()), file->outline().shape,
                       file->outline().triangles}),
          file_(std::move(file)) {}

    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override {
        const std::uint64_t number = file_->order().number(page);
        {
            const std::scoped_lock lock(mutex_);
            const auto found = records_.find(number);
            if (found != records_.end()) return found->second;
        }
        ORO_TRY(PageRecord record, file_->record(page));
        const std::scoped_lock lock(mutex_);
        if (records_.size() >= records_kept) records_.clear();
        records_.emplace(number, record);
        return record;
    }

    Result<void> load(const PageIndex& page, gpu::PageBlock& block) const override {
        const auto payload = std::make_unique<PagePayload>();
        ORO_CHECK(file_->payload(page, *payload));
        const auto elevations = std::make_unique<PageElevations>(PageElevations{payload->H_m});
        const PageHeights heights = page_heights(facts().grid, file_->outline().undulation,
                                                 facts().shape.exaggeration, *elevations, page);
        build_page(facts().grid, facts().shape, heights, page, block);
        for (std::size_t i = 0; i < gpu::meshlets_per_page; ++i) {
            block.meshlets[i].error_m = payload->error_m[i];
            block.meshlets[i].lod_radius = payload->lod_radius_m[i];
        }
        return {};
    }

    // A file does not hold them, and they take all posts: 4 bytes each, read once.
    [[nodiscard]] bool knows_means() const override {
        constexpr std::size_t most_posts = std::size_t{1} << 28U;
        return facts().grid.post_count() <= most_posts;
    }
    Result<void> load_means(const PageIndex& page, gpu::PageMeans& means) const override {
        {
            const std::scoped_lock lock(means_mutex_);
            if (!means_) ORO_CHECK(make_means());
        }
        means_->page(page, means);
        return {};
    }

  private:
    Result<void> make_means() const {
        ORO_TRY(const HeightField field, field_in_memory(*file_));
        heights_ = drawn_heights(field, facts().shape.exaggeration, thread_count());
        means_.emplace(facts().grid, heights_, facts().shape.exaggeration, thread_count());
        return {};
    }

    std::shared_ptr<const RegionFile> file_;
    mutable std::mutex mutex_;
    mutable std::unordered_map<std::uint64_t, PageRecord> records_;
    mutable std::mutex means_mutex_;
    mutable DrawnHeights heights_;
    mutable std::optional<GroundMeans> means_;
};

// Pages of level 0 by number, those asked for last in front.
class FilePosts : public PostSource {
  public:
    FilePosts(std::shared_ptr<const RegionFile> file, std::size_t pages)
        : file_(std::move(file)), capacity_(std::max<std::size_t>(pages, 4)) {}

    [[nodiscard]] float H_m(int row, int column) const override {
        constexpr int quads = static_cast<int>(gpu::page_quads);
        const PageLayout layout = file_->order().layout(0);
        // The last row and column of a page are the next one's first, where there is a next one.
        const PageIndex page{std::min(row / quads, layout.rows - 1),
                             std::min(column / quads, layout.columns - 1), 0};
        const int in_row = row - page.row * quads + 1, in_column = column - page.column * quads + 1;
        const std::scoped_lock lock(mutex_);
        return posts_of(
            page)[static_cast<std::size_t>(in_row * static_cast<int>(gpu::height_stride) + in_column)];
    }

    [[nodiscard]] Result<void> health() const override {
        const std::scoped_lock lock(mutex_);
        return fault_ ? Result<void>(*fault_) : Result<void>();
    }

  private:
    using Posts = std::array<float, gpu::page_heights>;
    struct Kept {
        std::uint64_t number;
        std::unique_ptr<Posts> posts;
    };

    const Posts& posts_of(const PageIndex& page) const {
        const std::uint64_t number = file_->order().number(page);
        if (!kept_.empty() && kept_.front().number == number) return *kept_.front().posts;
        const auto found = kept_by_number_.find(number);
        if (found != kept_by_number_.end()) {
            kept_.splice(kept_.begin(), kept_, found->second);
            return *kept_.front().posts;
        }
        if (kept_.size() >= capacity_) {
            kept_by_number_.erase(kept_.back().number);
            kept_.pop_back();
        }
        const auto payload = std::make_unique<PagePayload>();
        if (const Result<void> read = file_->payload(page, *payload); !read.ok()) {
            if (!fault_) fault_ = read.error();
            payload->H_m.fill(void_height_m);
        }
        kept_.push_front({number, std::make_unique<Posts>(payload->H_m)});
        kept_by_number_[number] = kept_.begin();
        return *kept_.front().posts;
    }

    std::shared_ptr<const RegionFile> file_;
    std::size_t capacity_;
    mutable std::mutex mutex_;
    mutable std::list<Kept> kept_;
    mutable std::unordered_map<std::uint64_t, std::list<Kept>::iterator> kept_by_number_;
    mutable std::optional<Error> fault_;  // the first
};

}  // namespace

std::unique_ptr<RegionPages> pages_of_file(std::shared_ptr<const RegionFile> file) {
    return std::make_unique<FilePages>(std::move(file));
}

HeightField field_of_file(std::shared_ptr<const RegionFile> file, std::size_t memory_bytes) {
    HeightField field;
    field.grid = file->outline().grid;
    field.undulation = file->outline().undulation;
    field.range = HeightRange{file->outline().lowest_H_m, file->outline().highest_H_m,
                              static_cast<std::size_t>(file->outline().voids)};
    field.posts =
        std::make_shared<FilePosts>(std::move(file), memory_bytes / (sizeof(float) * gpu::page_heights));
    return field;
}

Result<HeightField> field_in_memory(const RegionFile& file) {
    constexpr int quads = static_cast<int>(gpu::page_quads), stride = static_cast<int>(gpu::height_stride);
    const PageLayout layout = file.order().layout(0);
    const std::uint64_t pages = layout.count();  // numbered before those of all other levels
    // Memory is taken for pages that are there, not for what the header says.
    for (std::uint64_t i = 0; i < pages; ++i) ORO_CHECK(file.record(file.order().index(i)));
    HeightField field;
    field.grid = file.outline().grid;
    field.undulation = file.outline().undulation;
    if (field.grid.net) field.N_of_posts_m = N_of_net_m(*field.grid.net, field.undulation, thread_count());
    field.H_m.assign(field.grid.post_count(), void_height_m);
    const auto payload = std::make_unique<PagePayload>();
    for (std::uint64_t i = 0; i < pages; ++i) {
        const PageIndex page = file.order().index(i);
        ORO_CHECK(file.payload(page, *payload));
        const int first_row = page.row * quads, first_column = page.column * quads;
        const int rows = std::min(quads + 1, field.grid.rows() - first_row);
        const int columns = std::min(quads + 1, field.grid.columns() - first_column);
        for (int row = 0; row < rows; ++row)
            std::copy_n(
                payload->H_m.begin() + (row + 1) * stride + 1, columns,
                field.H_m.begin() + (std::ptrdiff_t{first_row} + row) * field.grid.columns() + first_column);
    }
    return field;
}

}  // namespace oro
