// What a window remembers of the last one.
#include "apps/window/kept_settings.h"

#include <gtest/gtest.h>

namespace {

TEST(KeptSettings, PanelsComeBackByName) {
    oro::Panels panels;
    panels.layers = panels.statistics = true;
    panels.place = panels.keys = true;  // not kept
    const auto names = oro::panels_by_name(panels);
    EXPECT_TRUE(names.at("layers"));
    EXPECT_FALSE(names.at("sun"));
    EXPECT_FALSE(names.contains("place"));
    const oro::Panels again = oro::panels_of_names(names);
    EXPECT_TRUE(again.layers && again.statistics);
    EXPECT_FALSE(again.sun || again.place || again.keys || again.hidden || again.messages);
}

// Of a file that somebody has written: panels over each other are not both opened.
TEST(KeptSettings, PanelsThatLieOverEachOtherAreNotBothOpened) {
    const oro::Panels panels =
        oro::panels_of_names({{"sun", true}, {"statistics", true}, {"a panel of later", true}});
    EXPECT_NE(panels.sun, panels.statistics);
}

TEST(KeptSettings, TheSizeIsThatOfTheLastWindowUnlessSomebodySaysIt) {
    oro::WindowSettings settings;
    settings.width_px = 901, settings.height_px = 507;
    oro::WindowOptions options;
    EXPECT_EQ(oro::with_kept_size(options, settings).view.size, "901x507");
    options.view.size = "640x480";
    EXPECT_EQ(oro::with_kept_size(options, settings).view.size, "640x480");
    options.view.size.reset();
    options.view_file = "p.png";
    EXPECT_FALSE(oro::with_kept_size(options, settings).view.size);
}

}  // namespace
