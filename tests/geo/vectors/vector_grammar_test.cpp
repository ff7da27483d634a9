// Files by grammar: no signal, no silence. All places that stand in a file are drawn, or left out and
// counted. OROGRAPH_GRAMMAR_FILES=N tries so many instead of a few hundred, OROGRAPH_GRAMMAR_SEED=N from
// another seed (scripts/vector-grammar).
#include <gtest/gtest.h>

#include <iostream>
#include <memory>
#include <string>

#include "geo/vectors/vector_file.h"
#include "tests/geo/vectors/table_grammar.h"
#include "tests/geo/vectors/vector_grammar.h"
#include "tests/geo/vectors/written_vectors.h"
#include "tests/support/asked_count.h"

namespace oro {
namespace {
using test::asked_number;
using test::GrammarFile;
using test::written;

std::size_t drawn_places(const VectorFile& file) {
    std::size_t all = 0;
    for (const VectorLayer& layer : file.layers) {
        for (const VectorShape& shape : layer.shapes) {
            EXPECT_LT(shape.record, layer.records.size());
            for (const auto& path : shape.paths) {
                all += path.size();
                for (const VectorPlace& place : path) {
                    EXPECT_LE(std::abs(place.lat_deg), 90.0);
                    EXPECT_LE(std::abs(place.lon_deg), 180.0);
                }
            }
        }
    }
    return all;
}

// As it is, or with a mark, or in UTF-16.
std::string encoded(const std::string& text, std::uint64_t how) {
    if (how % 10 == 0) return "\xef\xbb\xbf" + text;
    if (how % 10 > 1 || text.find_first_of("\x80\xc2\xc3") != std::string::npos) return text;
    std::string wide = "\xff\xfe";
    for (const char c : text) wide += c, wide += '\0';
    return wide;
}

void check(const GrammarFile& made, const std::string& name, std::uint64_t number) {
    const std::string file = written(name, encoded(made.text, number));
    const auto read = read_vectors(file);
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(drawn_places(*read) + read->ring_ends + read->places_left_out, made.places);
    EXPECT_TRUE(read->places_left_out == 0 || !read->notes.empty());
    if (!made.is_legal) return;
    EXPECT_EQ(read->places_left_out, 0U);
    // What is legal and a choice of the reader is told.
    for (const std::string& note : read->notes)
        EXPECT_TRUE(note.find("more than three numbers") != std::string::npos ||
                    note.find("commas for decimals") != std::string::npos ||
                    note.find("if commas stand for decimals") != std::string::npos ||
                    note.find("are taken for longitudes") != std::string::npos)
            << note;
}

TEST(VectorGrammar, PlacesInAFileAreDrawnOrTold) {
    const std::uint64_t files = asked_number("OROGRAPH_GRAMMAR_FILES", 1000),
                        seed = asked_number("OROGRAPH_GRAMMAR_SEED", 47);
    std::cout << files << " files, seed " << seed << "\n";
    std::size_t places = 0, legal = 0;
    for (std::uint64_t i = 0; i < files; ++i) {
        const std::uint64_t own = seed * 1'000'003 + i;
        std::unique_ptr<test::VectorGrammar> grammar;
        const char* name = "g.geojson";
        if (i % 5 == 0)
            grammar = std::make_unique<test::KmlGrammar>(own), name = "g.kml";
        else if (i % 5 == 1)
            grammar = std::make_unique<test::GpxGrammar>(own), name = "g.gpx";
        else if (i % 5 == 2)
            grammar = std::make_unique<test::CsvGrammar>(own), name = "g.csv";
        else if (i % 5 == 3)
            grammar = std::make_unique<test::TopoJsonGrammar>(own), name = "g.topojson";
        else
            grammar = std::make_unique<test::GeoJsonGrammar>(own);
        const GrammarFile made = grammar->file();
        places += made.places, legal += made.is_legal ? 1 : 0;
        check(made, name, own);
        if (HasFailure()) {
            FAIL() << "file " << i << " of seed " << seed << ":\n" << made.text;
        }
    }
    std::cout << places << " places, " << legal << " files without a fault\n";
}

}  // namespace
}  // namespace oro
