// The view in an XMP packet: as Orograph writes it, as other programs rewrite it, and damaged.
#include "geo/pictures/geotags_xmp.h"

#include <gtest/gtest.h>

#include <string>

namespace oro {
namespace {

std::string packet(const std::string& inside) {
    return "<?xpacket begin=\"\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">"
           "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">" +
           inside + "</rdf:RDF></x:xmpmeta>\n<?xpacket end=\"w\"?>";
}

std::string described(const std::string& inside, const std::string& attributes = "") {
    return packet("<rdf:Description rdf:about=\"\" xmlns:orograph=\"urn:orograph:1.0/\"" + attributes + ">" +
                  inside + "</rdf:Description>");
}

TEST(ViewInXmp, IsReadAsItWasWritten) {
    Geotags tags;
    tags.geoid = "EGM96";
    tags.view_json = "{\"sources\":[\"a<b>&c\\u000d\xC3\xA9\r\n\t'\\\"' \xF0\x9F\x8F\x94\"]}";
    const auto xmp = xmp_packet(tags, PictureFormat::png);
    ASSERT_TRUE(xmp.ok()) << xmp.error().line();
    const auto view = view_in_xmp(*xmp, "a.png");
    ASSERT_TRUE(view.ok()) << view.error().line();
    EXPECT_EQ(*view, tags.view_json);
}

// Source of the names and of where rows count from: Google, Photo Sphere XMP Metadata.
TEST(PanoramaInXmp, TellsWhereThePictureLiesOnItsCylinder) {
    Geotags tags;
    tags.view_json = "{}";
    tags.width_px = 900;
    tags.height_px = 500;
    tags.heading_deg = 20.5;
    EXPECT_EQ(xmp_packet(tags, PictureFormat::png)->find("GPano"), std::string::npos);
    tags.panorama = PanoramaTag{90.0, 210, 120, 300};
    const auto xmp = xmp_packet(tags, PictureFormat::png);
    ASSERT_TRUE(xmp.ok());
    for (const char* field :
         {"xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\"", "ProjectionType>cylindrical<",
          "PoseHeadingDegrees>20.5<", "CroppedAreaImageWidthPixels>900<", "CroppedAreaImageHeightPixels>500<",
          "FullPanoWidthPixels>3600<", "CroppedAreaLeftPixels>1350<", "CroppedAreaTopPixels>-210<",
          "LargestValidInteriorRectTop>120<", "LargestValidInteriorRectHeight>300<"})
        EXPECT_NE(xmp->find(field), std::string::npos) << field;
    EXPECT_EQ(*view_in_xmp(*xmp, "a.png"), "{}");
}

// XMP (ISO 16684-1, 7.9.2.2): a simple property may stand as an attribute, and a prefix is anybody's choice.
TEST(ViewInXmp, IsFoundWhereOtherProgramsPutIt) {
    for (const std::string& xmp :
         {described("<orograph:View>{&quot;a&quot;:&#49;&#x2B;&apos;&amp;lt;}</orograph:View>"),
          described("", " orograph:View=\"{&quot;a&quot;:1+'&amp;lt;}\""),
          packet("<rdf:Description xmlns:ns7=\"urn:orograph:1.0/\"><ns7:Yaw>1</ns7:Yaw>"
                 "<ns7:View>{\"a\":1+'&amp;lt;}</ns7:View></rdf:Description>"),
          packet("<rdf:Description><o:View xmlns:o=\"urn:orograph:1.0/\">{\"a\":1+'&amp;lt;}</o:View>"
                 "</rdf:Description>")}) {
        const auto view = view_in_xmp(xmp, "a.png");
        ASSERT_TRUE(view.ok()) << view.error().line() << "\n" << xmp;
        EXPECT_EQ(*view, "{\"a\":1+'&lt;}") << xmp;
    }
}

TEST(ViewInXmp, DamageIsTold) {
    const std::string whole = described("<orograph:View>{\"a\":1}</orograph:View>");
    struct Case {
        std::string xmp;
        std::string reported;
    };
    for (const Case& c :
         {Case{whole.substr(0, whole.find("</orograph:View>")), "damaged at its byte"},
          Case{described("<orograph:View>{&quo;}</orograph:View>"), "damaged entity"},
          Case{described("<orograph:View>{&#0;}</orograph:View>"), "damaged entity"},
          Case{described("<orograph:View>{&#x110000;}</orograph:View>"), "damaged entity"},
          Case{described("<orograph:View></orograph:View>"), "an empty view"},
          Case{described("<orograph:Yaw>1</orograph:Yaw>"), "no view of Orograph"},
          Case{packet("<rdf:Description xmlns:o=\"urn:other/\"><o:View>1</o:View></rdf:Description>"),
               "no view of Orograph"},
          Case{"", "no view of Orograph"}}) {
        const auto view = view_in_xmp(c.xmp, "a.png");
        ASSERT_FALSE(view.ok()) << c.xmp;
        EXPECT_NE(view.error().line().find(c.reported), std::string::npos) << view.error().line();
    }
}

// A parser that calls itself for each element would run out of stack.
TEST(ViewInXmp, DeepNestingIsHarmless) {
    std::string open, close;
    for (int i = 0; i < 500'000; ++i) {
        open += "<a>";
        close += "</a>";
    }
    for (const std::string& inside : {open + "<orograph:View>1</orograph:View>" + close, open}) {
        const auto view = view_in_xmp(described(inside), "a.png");
        EXPECT_FALSE(view.ok());
    }
}

}  // namespace
}  // namespace oro
