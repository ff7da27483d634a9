# The Debian packages that Orograph needs; sourced by scripts/set-up.

build_packages=(
  cmake g++ ninja-build pkg-config
  glslang-tools libvulkan-dev
  libgdal-dev libgeographiclib-dev libproj-dev proj-data libgeos-dev libsqlite3-dev
  libglm-dev libglfw3-dev libimgui-dev libcli11-dev nlohmann-json3-dev
  libpng-dev libjpeg-dev libtiff-dev libexif-dev libfreetype-dev libharfbuzz-dev fonts-dejavu-core
  libzstd-dev libxxhash-dev liberfa-dev libpugixml-dev libutfcpp-dev libcpp-httplib-dev libssl-dev
  libcurl4-openssl-dev zlib1g-dev libdeflate-dev libmeshoptimizer-dev
)

# To tell a GPU with mesh shaders from one without; only where there is a GPU.
gpu_packages=(vulkan-tools)

# libvulkan1 asks for a driver only by "Recommends", which --no-install-recommends leaves out.
driver_packages=(mesa-vulkan-drivers)

test_packages=(
  libgtest-dev vulkan-validationlayers
  gdal-bin libimage-exiftool-perl xvfb xdotool zip duktape
  python3-numpy python3-gdal python3-rasterio python3-xarray
)
