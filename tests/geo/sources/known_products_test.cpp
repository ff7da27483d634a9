// Files of products by their names, as downloads have them: which hold heights, above what, and what the
// others hold.
#include "geo/sources/known_products.h"

#include <gtest/gtest.h>

#include <string>

namespace oro {
namespace {

std::string heights_by_name(const char* name) {
    const auto known = known_file(name);
    if (!known) return "unknown";
    if (!known->holds.empty()) return "no heights: " + std::string(known->holds);
    return std::string(known->heights_name);
}

TEST(KnownProducts, HeightsAreAboveWhatTheProductSays) {
    constexpr const char* ellipsoid = "ellipsoidal height (EPSG:4979 WGS 84)";
    constexpr const char* egm96 = "EGM96 height";
    constexpr const char* egm2008 = "EPSG:3855 EGM2008 height";
    for (const auto& [name, heights] : {
             std::pair{"TDM1_DEM__30_N47E011_DEM.tif", ellipsoid},
             {"TDM1_DEM__04_S56W068_DEM.tif", ellipsoid},
             {"TDM1_EDEM_10_N47E011_EDEM_W84.tif", ellipsoid},
             {"TDM1_EDEM_10_N47E011_EDEM_EGM.tif", egm2008},
             {"Copernicus_DSM_COG_10_N47_00_E011_00_DEM.tif", egm2008},
             {"Copernicus_DSM_30_N47_00_E011_00_DEM.dt1", egm2008},
             {"N47E011_FABDEM_V1-2.tif", egm2008},
             {"23_44_10m_v4.1_dem.tif", ellipsoid},
             {"12_38_10m_v3.0_reg_dem.tif", ellipsoid},
             {"45_18_8m_dem.tif", ellipsoid},
             {"45_18_1_1_5m_dem.tif", ellipsoid},
             {"23_44_1_1_2m_v4.1_dem.tif", ellipsoid},
             {"rema_mosaic_100m_v2.0_filled_cop30_dem.tif", ellipsoid},
             {"SETSM_s2s041_WV01_20200709_1020010099B32D00_102001009A8F7B00_2m_lsf_seg1_dem.tif", ellipsoid},
             {"AP_26733_FBS_F0950_RT1.dem.tif", ellipsoid},
             {"output_SRTMGL1_E.tif", ellipsoid},
             {"ASTGTMV003_N47E011_dem.tif", egm96},
             {"ALPSMLC30_N047E011_DSM.tif", egm96},
             {"N047E011_AVE_DSM.tif", egm96},
             {"NASADEM_HGT_n47e011.tif", egm96},
             {"n47_e011_1arc_v3.tif", egm96},
             {"srtm_39_03.tif", egm96},
             {"USGS_13_n40w106_20230602.tif", "EPSG:5703 NAVD88 height"},
             {"USGS_13_n20w156.tif", ""},
             {"swissalti3d_2019_2624-1190_0.5_2056_5728.tif", "EPSG:5728 LN02 height"},
             {"TDM1_DEM__30_N47E011_DEM_egm96.tif", ""},
             {"Copernicus_DSM_COG_10_N47_00_E011_00_DEM (1).tif", egm2008},
             {"copy of N47E011_FABDEM_V1-2.tif", egm2008},
             {"n30e000_dem - Copy (2).tif", egm96},
             {"n30e000_dem copy 3.tif", egm96},
             {"n30e000_dem 3.tif", "unknown"},
             {"32_47_1m_dtm.tif", "unknown"},
             {"copy.tif", "unknown"},
             {"(1).tif", "unknown"},
             {"dem.tif", "unknown"},
             {"N46E008.hgt", "unknown"},
         })
        EXPECT_EQ(heights_by_name(name), heights) << name;
}

TEST(KnownProducts, CompanionsAreKnownWhateverTheirLetters) {
    for (const char* name : {"TDM1_DEM__30_N47E011_AM2.tif",
                             "TDM1_DEM__30_N47E011_AMP.tif",
                             "TDM1_DEM__30_N47E011_COM.tif",
                             "TDM1_DEM__30_N47E011_COV.tif",
                             "TDM1_DEM__30_N47E011_HEM.tif",
                             "TDM1_DEM__04_N47E011_IPM.tif",
                             "TDM1_DEM__04_N47E011_LSM.tif",
                             "tdm1_dem__30_n47e011_wam.tif",
                             "TDM1_DEM__30_N47E011_DEM_ABS_QL.tif",
                             "TDM1_EDEM_10_N47E011_EDM.tif",
                             "TDM1_EDEM_10_N47E011_LCM.tif",
                             "TDM1_DCM__10_N47E011_LAST1622_DCM.tif",
                             "Copernicus_DSM_10_N47_00_E011_00_EDM.tif",
                             "Copernicus_DSM_10_N47_00_E011_00_FLM.tif",
                             "Copernicus_DSM_10_N47_00_E011_00_HEM.tif",
                             "Copernicus_DSM_10_N47_00_E011_00_WBM.tif",
                             "Copernicus_DSM_10_N47_00_E011_00_DEM_QL.tif",
                             "Copernicus_DSM_COG_10_N46_00_E008_00_HEM (1).tif",
                             "Copernicus_DSM_COG_10_N46_00_E008_00_HEM(1).tif",
                             "Copernicus_DSM_COG_10_N46_00_E008_00_HEM - Copy.tif",
                             "Copernicus_DSM_COG_10_N46_00_E008_00_HEM - Kopie (2).tif",
                             "Copernicus_DSM_COG_10_N46_00_E008_00_WBM copy.tif",
                             "Copernicus_DSM_COG_10_N46_00_E008_00_WBM copy 2.tif",
                             "Copernicus_DSM_COG_10_N46_00_E008_00_WBM (copy).tif",
                             "Copernicus_DSM_COG_10_N46_00_E008_00_WBM (another copy).tif",
                             "Copy of Copernicus_DSM_COG_10_N46_00_E008_00_FLM.tif",
                             "45_18_8m_day.tif",
                             "45_18_8m_err.tif",
                             "23_44_10m_v4.1_count.tif",
                             "23_44_10m_v4.1_mad.tif",
                             "23_44_10m_v4.1_countmt.tif",
                             "23_44_10m_v4.1_mindate.tif",
                             "23_44_10m_v4.1_maxdate.tif",
                             "23_44_10m_v4.1_browse.tif",
                             "23_44_10m_v4.1_datamask.tif",
                             "SETSM_s2s041_WV01_x_2m_seg1_matchtag.tif",
                             "SETSM_s2s041_WV01_x_2m_seg1_bitmask.tif",
                             "SETSM_s2s041_WV01_x_2m_seg1_dem_10m_shade_masked.tif",
                             "ASTGTMV003_N47E011_num.tif",
                             "ASTWBDV001_N47E011_att.tif",
                             "ASTWBDV001_N47E011_dem.tif",
                             "ALPSMLC30_N047E011_MSK.tif",
                             "ALPSMLC30_N047E011_STK.tif",
                             "N047E011_AVE_STK.tif",
                             "NASADEM_NUMNC_n47e011.nc",
                             "NASADEM_SIM_n47e011.tif",
                             "AP_26733_FBS_F0950_RT1_HH.tif",
                             "n30e000_20101117_gmted_std075.tif",
                             "GEBCO_2023_TID.tif",
                             "ETOPO_2022_v1_60s_N90W180_geoid.tif"})
        EXPECT_TRUE(heights_by_name(name).starts_with("no heights: "))
            << name << ": " << heights_by_name(name);
    EXPECT_EQ(heights_by_name("TDM1_DEM__30_N47E011_AMP.tif"), "no heights: radar amplitude");
    EXPECT_EQ(heights_by_name("TDM1_DEM__30_N47E011_DEM_compressed.tif"),
              "ellipsoidal height (EPSG:4979 WGS 84)")
        << "a part of a name is whole";
}

}  // namespace
}  // namespace oro
