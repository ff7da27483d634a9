#include "geo/sources/known_products.h"

#include <array>

#include "geo/files/letter_case.h"
#include "geo/files/name_pattern.h"

namespace oro {
namespace {

struct Reference {
    std::string_view crs, name;
};
constexpr Reference ellipsoid{"EPSG:4979", "ellipsoidal height (EPSG:4979 WGS 84)"};
constexpr Reference egm96{"", "EGM96 height"};
constexpr Reference egm2008{"EPSG:4326+3855", "EPSG:3855 EGM2008 height"};
constexpr Reference navd88{"EPSG:4326+5703", "EPSG:5703 NAVD88 height"};
constexpr Reference ln02{"EPSG:4326+5728", "EPSG:5728 LN02 height"};
constexpr Reference left_open{};

// Parts of a name, and what a file holds that has one of them.
struct Companion {
    std::string_view parts, holds;
};

// Patterns are those of matches_name(), in small letters, of names without their ending; a companion's are of
// one part of a name, as `_`, `-`, `.` and blanks part it. The first row that has a file among its files
// decides, and of its companions the first. What is none of them holds heights.
struct Product {
    std::string_view name, files;
    Reference heights;
    std::array<Companion, 14> companions{};
};

constexpr std::array products{
    // Wessel, TanDEM-X Ground Segment DEM Products Specification, TD-GS-PS-0021, 3.1 (2016): file names and
    // layers; heights are above the WGS84 ellipsoid.
    Product{"TanDEM-X DEM",
            "tdm1_dem__##_*|tdm1_idem_*|tdm1_fdem_*|tdm1_hdem_*",
            ellipsoid,
            {{{"ql", "a preview"},
              {"am2", "smallest radar amplitude"},
              {"amp", "radar amplitude"},
              {"com", "consistency mask"},
              {"cov", "number of coverages"},
              {"hem", "height error"},
              {"ipm", "interpolation mask"},
              {"lsm", "layover and shadow mask"},
              {"wam", "water mask"}}}},
    // DLR, data guide of the TanDEM-X 30m EDEM and DCM (2023): the EDEM in two files, above the ellipsoid
    // (W84) and above EGM2008 (EGM); edits, errors and land cover beside them.
    Product{"TanDEM-X EDEM", "tdm1_edem_*_egm*", egm2008},
    Product{"TanDEM-X EDEM",
            "tdm1_edem_*",
            ellipsoid,
            {{{"ql", "a preview"},
              {"edm", "editing mask"},
              {"hem", "height error"},
              {"lcm", "land cover"},
              {"com", "consistency mask"},
              {"cov", "number of coverages"},
              {"wam|wbm", "water mask"},
              {"amp|am2", "radar amplitude"}}}},
    Product{"TanDEM-X DCM", "tdm1_dcm_*", left_open, {{{"*", "changes of height"}}}},
    // Airbus, Copernicus DEM Product Handbook, 5.0 (2024): file names and layers; EGM2008.
    Product{"Copernicus DEM",
            "copernicus_dsm_*|copernicus_dem_*",
            egm2008,
            {{{"ql", "a preview"},
              {"edm", "editing mask"},
              {"flm", "filling mask"},
              {"hem", "height error"},
              {"wbm", "water body mask"},
              {"acm", "accuracy"}}}},
    Product{"WorldDEM",
            "worlddem_*",
            egm2008,
            {{{"ql", "a preview"},
              {"edm", "editing mask"},
              {"flm", "filling mask"},
              {"hem", "height error"},
              {"wbm|wam", "water mask"},
              {"amp|am2", "radar amplitude"},
              {"cov", "number of coverages"},
              {"com", "consistency mask"}}}},
    // FABDEM is made from GLO-30 (Hawker and others, 2022, doi 10.1088/1748-9326/ac4d4f): EGM2008.
    Product{"FABDEM", "?##?###_fabdem*", egm2008},
    // Polar Geospatial Center, guides to ArcticDEM, REMA and EarthDEM (mosaics v4.1 and v2.0, strips s2s041):
    // heights are above the WGS84 ellipsoid.
    Product{"ArcticDEM, REMA or EarthDEM",
            "arcticdem_*|rema_*|earthdem_*|setsm_*|##_##_*m_v#*|utm##?_##_##_*m_v#*|"
            // Of releases before 2: 8 m and, of quarters, 5 m; dates and errors are only theirs.
            "##_##_8m_*|##_##_#_#_8m_*|##_##_#_#_5m_*|##_##_*m_day*|##_##_*m_err*",
            ellipsoid,
            {{{"shade*|hillshade*", "a hillshade"},
              {"browse*", "a preview"},
              {"matchtag*", "match mask"},
              {"bitmask*|mask|edgemask", "quality mask"},
              {"datamask*", "data mask"},
              {"countmt", "number of matches"},
              {"count", "number of strips"},
              {"mad", "median deviation"},
              {"mindate|maxdate|day|date", "dates"},
              {"err", "height error"},
              {"ortho*", "an image"},
              {"slope*", "slope"}}}},
    // NASA and METI, ASTER GDEM V3 User Guide (2019): EGM96; _num counts scenes and names other sources.
    Product{"ASTER GDEM", "astgtm*", egm96, {{{"num", "number of scenes"}, {"qa*", "quality"}}}},
    Product{"ASTER water bodies",
            "astwbd*",
            egm96,
            {{{"att", "kinds of water"}, {"dem", "heights of water alone"}}}},
    // JAXA EORC, AW3D30 Product Description, 4.1 (2024): file names; EGM96.
    Product{"AW3D30",
            "alpsmlc30_*|?###?###_ave_*|?###?###_med_*",
            egm96,
            {{{"msk", "mask of clouds, water and fills"},
              {"stk", "number of scenes"},
              {"qai|hdr|lst|ver", "quality"}}}},
    // LP DAAC, NASADEM User Guide, 1.0 (2020): _HGT's heights are EGM96; _SIM, _SC, _SSP hold other layers.
    Product{"NASADEM",
            "nasadem_*",
            egm96,
            {{{"num*", "sources of each height"},
              {"swb*", "water mask"},
              {"sim|img", "radar amplitude"},
              {"sc|slope|aspect|plan|profile", "slope, aspect and curvature"},
              {"err", "height error"}}}},
    // LP DAAC, SRTM User Guide, 3.0 (2015); USGS EarthExplorer's and CGIAR-CSI's names of the same: EGM96.
    Product{"SRTM",
            "?##?###.srtm*|?##_?###_?arc_v#*|srtm_##_##*",
            egm96,
            {{{"num", "sources of each height"},
              {"srtmswbd*|swb*", "water mask"},
              {"std|err", "height error"},
              {"mk|msk|mask", "mask of fills"}}}},
    // Yamazaki and others, MERIT DEM (2017) and MERIT Hydro (2019): EGM96.
    Product{"MERIT",
            "?##?###_dem|?##?###_elv|?##?###_dir|?##?###_up?|?##?###_wth|?##?###_hnd",
            egm96,
            {{{"dir", "flow directions"},
              {"up?", "upstream areas"},
              {"wth", "widths of rivers"},
              {"hnd", "heights above drainage"}}}},
    // Danielson and Gesch, GMTED2010, USGS Open-File Report 2011-1073: EGM96.
    Product{"GMTED2010", "*_gmted_*", egm96, {{{"std###", "standard deviation"}}}},
    // OpenTopography's global data: names that end in _E are above the ellipsoid.
    Product{"SRTM of OpenTopography", "*srtmgl1_e|*srtmgl1_ellip*", ellipsoid},
    Product{"AW3D30 of OpenTopography", "*aw3d30_e|*aw3d30_ellip*", ellipsoid},
    Product{"Copernicus DEM of OpenTopography", "output_cop30|output_cop90", egm2008},
    // ASF, ALOS PALSAR RTC Product Guide, 1.2 (2015): the DEM beside the images is above the ellipsoid.
    Product{"ALOS PALSAR RTC",
            "ap_#####_*",
            ellipsoid,
            {{{"hh|hv|vv|vh", "radar amplitude"}, {"inc", "angles"}, {"ls", "layover and shadow mask"}}}},
    // Shean, High Mountain Asia 8-meter DEMs (NSIDC, 2017): above the WGS84 ellipsoid.
    Product{"HMA 8 m DEM", "hma_dem8m_*", ellipsoid},
    // USGS, 3D Elevation Program: NAVD88 on the continent, local datums on islands.
    Product{"USGS 3DEP",
            "usgs_*_n1#?*|usgs_*_n20w*|usgs_*_n21w*|usgs_*_n22w*|usgs_*_n23w*|usgs_*_s1#?*|usgs_*_hi_*|usgs_*"
            "_pr_*|"
            "usgs_*_gu_*",
            left_open,
            {{{"thumb*|browse*|preview*", "a preview"}}}},
    Product{"USGS 3DEP",
            "usgs_13_n##*|usgs_1_n##*|usgs_2_n##*|usgs_19_n##*|usgs_ned_*|usgs_1m_##_*|usgs_one_meter_*|"
            "imgn##w###_*|floatn##w###_*|grdn##w###_*",
            navd88,
            {{{"thumb*|browse*|preview*", "a preview"}}}},
    // swisstopo, swissALTI3D and swissSURFACE3D Raster: their names end in the codes of their CRS and of
    // LN02.
    Product{"swissALTI3D or swissSURFACE3D", "swissalti3d_*_5728*|swisssurface3d-raster_*_5728*", ln02},
    // GEBCO, documentation of the grid (2023): TID tells how each height was found.
    Product{"GEBCO", "gebco_*", left_open, {{{"tid", "sources of each height"}}}},
    // NOAA, ETOPO 2022 User Guide: EGM2008.
    Product{"ETOPO 2022",
            "etopo_2022_*",
            egm2008,
            {{{"geoid", "heights of the geoid"}, {"sid", "sources of each height"}}}},
};

// Words of a name by which it says that heights were turned into those of another reference.
constexpr std::string_view turned = "*egm96*|*egm08*|*egm2008*|*_geoid*|*orthom*|*_navd*|*_msl*|*ellips*";

bool has_part(std::string_view patterns, std::string_view stem) {
    if (patterns.empty()) return false;
    while (true) {
        const std::size_t end = stem.find_first_of(between_words);
        if (matches_name(patterns, stem.substr(0, end))) return true;
        if (end == std::string_view::npos) return false;
        stem.remove_prefix(end + 1);
    }
}

std::string_view without_ending(std::string_view name) {
    const std::size_t dot = name.rfind('.');
    return dot == std::string_view::npos || dot == 0 ? name : name.substr(0, dot);
}

// What file managers and browsers put before the name of a copy, ...
constexpr std::array before_copies{std::string_view("copy of "), std::string_view("copy_of_"),
                                   std::string_view("kopie von "), std::string_view("copie de "),
                                   std::string_view("copia de ")};
// ... and behind it, where a number may follow.
constexpr std::string_view copy_words =
    "copy|another copy|#st copy|#nd copy|#rd copy|#th copy|##th copy|kopie|copie|copia|c\xc3\xb3pia";

std::string_view without_marks_behind(std::string_view text) {
    return text.substr(0, text.find_last_not_of(" _-") + 1);
}

// Without " (2)", or " 2" where that stands behind a word for a copy.
std::string_view without_copy_number(std::string_view stem) {
    const bool in_brackets = stem.ends_with(')');
    std::string_view rest = stem.substr(0, stem.size() - (in_brackets ? 1 : 0));
    const std::size_t digits = rest.size() - (rest.find_last_not_of("0123456789") + 1);
    if (digits == 0 || digits > 3 || digits == rest.size()) return stem;
    rest.remove_suffix(digits);
    if (!rest.ends_with(in_brackets ? '(' : ' ')) return stem;
    rest.remove_suffix(1);
    return without_marks_behind(rest);
}

// Without " - copy", " copy", "_copy", " (copy)".
std::string_view without_copy_word(std::string_view stem) {
    const bool in_brackets = stem.ends_with(')');
    const std::string_view inner = stem.substr(0, stem.size() - (in_brackets ? 1 : 0));
    for (std::size_t at = inner.find_first_of(" _-("); at != std::string_view::npos;
         at = inner.find_first_of(" _-(", at + 1)) {
        if (in_brackets != (inner[at] == '(') || !matches_name(copy_words, inner.substr(at + 1))) continue;
        return inner.substr(0, inner.find_last_not_of(" _-(", at) + 1);
    }
    return stem;
}

}  // namespace

std::string_view without_copy_marks(std::string_view stem) {
    for (std::size_t before = stem.size() + 1; !stem.empty() && stem.size() < before;) {
        before = stem.size();
        for (const std::string_view mark : before_copies)
            if (stem.size() > mark.size() && stem.starts_with(mark)) stem.remove_prefix(mark.size());
        const std::string_view word = without_copy_word(stem);
        if (!word.empty()) stem = word;
        const std::string_view number = without_copy_number(stem);
        // "a copy 2" is a copy; "site 2" is not.
        const bool is_copy = stem.ends_with(')') || without_copy_word(number).size() < number.size();
        if (!number.empty() && is_copy) stem = number;
    }
    return stem;
}

std::optional<KnownFile> known_file(std::string_view name) {
    const std::string small = lower_case(name);
    const std::string_view stem = without_copy_marks(without_ending(small));
    for (const Product& product : products) {
        if (!matches_name(product.files, stem)) continue;
        for (const Companion& companion : product.companions)
            if (has_part(companion.parts, stem)) return KnownFile{product.name, companion.holds, {}, {}};
        const Reference heights = matches_name(turned, stem) ? left_open : product.heights;
        return KnownFile{product.name, {}, heights.crs, heights.name};
    }
    return std::nullopt;
}

}  // namespace oro
