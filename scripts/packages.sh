# The Debian packages that Orograph needs; sourced by scripts/set-up.

build_packages=(
  ca-certificates cmake g++ make ninja-build pkg-config git
  glslang-dev glslang-tools spirv-tools libvulkan-dev vulkan-tools
  libgdal-dev libgeographiclib-dev libproj-dev proj-data
  libglm-dev libglfw3-dev libimgui-dev libcli11-dev nlohmann-json3-dev
  libpng-dev libjpeg-dev libtiff-dev libexif-dev
)

# libvulkan1 asks for a driver only by "Recommends", which --no-install-recommends leaves out.
driver_packages=(mesa-vulkan-drivers)

test_packages=(
  libgtest-dev libbenchmark-dev vulkan-validationlayers
  gdal-bin libimage-exiftool-perl xvfb xauth xdotool zip gzip
)
