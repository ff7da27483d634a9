#include "geo/files/network_paths.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace oro {
namespace {

bool is_allowed = false;

std::string& how_to_allow() {
    static std::string words;
    return words;
}

// Of what may stand in the environment, by the beginning of its name.
constexpr std::array network_prefixes{"AWS_",      "CPL_AWS_",   "VSIS3_",         "GS_",          "CPL_GS_",
                                      "VSIGS_",    "GOOGLE_",    "AZURE_",         "CPL_AZURE_",   "VSIAZ_",
                                      "OSS_",      "VSIOSS_",    "SWIFT_",         "OS_",          "WEBHDFS_",
                                      "CPL_VSIL_", "GDAL_HTTP_", "CURL_CA_BUNDLE", "SSL_CERT_FILE"};

// A wrong certificate is a wrong server.
constexpr std::array never_taken{"GDAL_HTTP_UNSAFESSL", "CPL_VSIL_GZIP_WRITE_PROPERTIES"};

// Signs that the user is known to a service's servers: with none of them nothing is signed.
struct Service {
    const char* unsigned_option;
    std::array<const char*, 9> signs;
};
constexpr std::array services{
    Service{"AWS_NO_SIGN_REQUEST",
            {"AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY", "AWS_PROFILE", "AWS_DEFAULT_PROFILE",
             "AWS_CONFIG_FILE", "CPL_AWS_CREDENTIALS_FILE", "AWS_ROLE_ARN", "AWS_WEB_IDENTITY_TOKEN_FILE",
             "AWS_CONTAINER_CREDENTIALS_RELATIVE_URI"}},
    Service{"GS_NO_SIGN_REQUEST",
            {"GS_ACCESS_KEY_ID", "GS_SECRET_ACCESS_KEY", "GOOGLE_APPLICATION_CREDENTIALS",
             "GS_OAUTH2_REFRESH_TOKEN", "GS_OAUTH2_PRIVATE_KEY", "GS_OAUTH2_PRIVATE_KEY_FILE",
             "CPL_GS_CREDENTIALS_FILE", "GDAL_HTTP_HEADER_FILE", nullptr}},
    Service{"AZURE_NO_SIGN_REQUEST",
            {"AZURE_STORAGE_CONNECTION_STRING", "AZURE_STORAGE_ACCESS_KEY", "AZURE_STORAGE_ACCESS_TOKEN",
             "AZURE_STORAGE_SAS_TOKEN", "AZURE_FEDERATED_TOKEN_FILE", nullptr, nullptr, nullptr, nullptr}}};

// Values that no text of ours may hold.
constexpr std::array secret_names{"AWS_SECRET_ACCESS_KEY",
                                  "AWS_ACCESS_KEY_ID",
                                  "AWS_SESSION_TOKEN",
                                  "GS_SECRET_ACCESS_KEY",
                                  "GS_ACCESS_KEY_ID",
                                  "GS_OAUTH2_REFRESH_TOKEN",
                                  "GS_OAUTH2_CLIENT_SECRET",
                                  "GS_OAUTH2_PRIVATE_KEY",
                                  "AZURE_STORAGE_ACCESS_KEY",
                                  "AZURE_STORAGE_CONNECTION_STRING",
                                  "AZURE_STORAGE_SAS_TOKEN",
                                  "AZURE_STORAGE_ACCESS_TOKEN",
                                  "OSS_SECRET_ACCESS_KEY",
                                  "OSS_ACCESS_KEY_ID",
                                  "SWIFT_KEY",
                                  "SWIFT_AUTH_TOKEN",
                                  "OS_PASSWORD",
                                  "OS_APPLICATION_CREDENTIAL_SECRET",
                                  "GDAL_HTTP_USERPWD",
                                  "GDAL_HTTP_PROXYUSERPWD",
                                  "GDAL_HTTP_BEARER",
                                  "GDAL_HTTP_COOKIE",
                                  "GDAL_HTTP_HEADERS"};

std::string in_environment(const char* name) {
    const char* const value = name == nullptr ? nullptr : std::getenv(name);
    return value == nullptr ? "" : value;
}

// As users of these services have it.
bool has_file_of_keys() {
    const std::string home = in_environment("HOME");
    return !home.empty() && access((home + "/.aws/credentials").c_str(), R_OK) == 0;
}

bool is_known_to(const Service& service) {
    const bool is_named =
        std::ranges::any_of(service.signs, [](const char* name) { return !in_environment(name).empty(); });
    return is_named || (&service == services.data() && has_file_of_keys());
}

constexpr std::array<std::string_view, 9> systems{
    "/vsicurl", "/vsis3", "/vsigs", "/vsiaz", "/vsiadls", "/vsioss", "/vsiswift", "/vsiwebhdfs", "/vsihdfs"};

}  // namespace

bool is_network_path(std::string_view path) {
    return std::ranges::any_of(systems, [&](std::string_view system) {
        if (!path.starts_with(system)) return false;
        const std::string_view rest = path.substr(system.size());
        return rest.starts_with('/') || rest.starts_with('?') || rest.starts_with("_streaming/");
    });
}

bool is_network_path_for_writing(std::string_view path) {
    return is_network_path(path) && !path.starts_with("/vsicurl") &&
           path.substr(0, path.find('/', 1)).find("_streaming") == std::string_view::npos;
}

void allow_network_paths() {
    is_allowed = true;
}

bool are_network_paths_allowed() {
    return is_allowed;
}

void tell_how_to_allow_network_paths(const std::string& words) {
    how_to_allow() = words;
}

Error network_path_refused(const std::string& path) {
    return {ErrorKind::usage, path,
            "lies on a network" + (how_to_allow().empty() ? ", and only files of this machine are opened"
                                                          : "; " + how_to_allow())};
}

Result<void> check_on_this_machine(const std::string& path) {
    if (!is_network_path(path)) return {};
    return Error{ErrorKind::usage, path, "lies on a network; this is written on this machine alone"};
}

std::vector<std::pair<std::string, std::string>> network_options_of_environment() {
    std::vector<std::pair<std::string, std::string>> options;
    for (char** line = environ; line != nullptr && *line != nullptr; ++line) {
        const std::string_view text = *line;
        const std::size_t equals = text.find('=');
        if (equals == std::string_view::npos) continue;
        const std::string_view name = text.substr(0, equals);
        const bool is_ours = std::ranges::any_of(
            network_prefixes, [&](const char* prefix) { return name.starts_with(prefix); });
        if (is_ours && std::ranges::find(never_taken, name) == never_taken.end())
            options.emplace_back(name, text.substr(equals + 1));
    }
    for (const Service& service : services)
        if (in_environment(service.unsigned_option).empty() && !is_known_to(service))
            options.emplace_back(service.unsigned_option, "YES");
    return options;
}

std::string without_keys(std::string text) {
    constexpr std::size_t shortest_key = 8;  // what is shorter is a word, and no key
    for (const char* const name : secret_names) {
        const std::string key = in_environment(name);
        if (key.size() < shortest_key) continue;
        for (std::size_t at = 0; (at = text.find(key, at)) != std::string::npos;)
            text.replace(at, key.size(), "{key}");
    }
    return text;
}

}  // namespace oro
