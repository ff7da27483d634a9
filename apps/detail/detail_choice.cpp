#include "apps/detail/detail_choice.h"

#include "apps/command_line/refusals.h"
#include "apps/command_line/whole_text.h"
#include "apps/report/figures.h"

namespace oro {

Result<std::optional<DetailChoice>> detail_choice_from(const std::string& text) {
    const std::size_t comma = text.find(',');
    long long halvings = 0;
    if (!read_whole(std::string_view(text).substr(0, comma), halvings) || halvings < 0 ||
        halvings > most_halvings)
        return refused("--detail", text,
                       "must be a whole number of halvings from 0 to " + std::to_string(most_halvings) +
                           ", or that and a radius in km, as 3,2.5");
    DetailChoice choice;
    choice.halvings = static_cast<int>(halvings);
    if (comma != std::string::npos) {
        double radius_km = 0.0;
        if (!read_whole(std::string_view(text).substr(comma + 1), radius_km) ||
            !(radius_km >= least_detail_km && radius_km <= most_detail_km))
            return refused("--detail", text,
                           "the radius in km " + between_words(least_detail_km, most_detail_km));
        choice.radius_km = radius_km;
    }
    if (halvings == 0) return std::optional<DetailChoice>();
    return std::optional(choice);
}

std::string words_of(const DetailChoice& choice) {
    return std::to_string(choice.halvings) +
           (choice.radius_km ? "," + all_digits(*choice.radius_km) : std::string());
}

}  // namespace oro
