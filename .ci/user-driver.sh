# A software driver in the user's home, without root: `./x setup --user`. Read by ../x.
# shellcheck shell=bash disable=SC2154 # system and user_driver are set there

# Puts the driver and the window libraries into the user's home from Debian's own packages.
setup_user() {
    local work part archive manifest library='' folders='' drivers='' name
    local field='"library_path"[[:space:]]*:[[:space:]]*"([^"]+)"'
    [ "$system" = Linux ] || fail "setup --user is for Linux; this system needs no driver of its own"
    if ! command -v apt-get >/dev/null || ! command -v dpkg-deb >/dev/null; then
        fail "setup --user works with Debian's packages only. Ask the administrator for: $(install_command "$(packages_for driver)" "$(packages_for window)")"
    fi
    work=$user_driver.part
    rm -rf "$work"
    mkdir -p "$work/apt/lists/partial" "$work/apt/cache/archives/partial"
    # apt as an ordinary user: lists and downloads of its own, the system's record of what is
    # installed, so that only the packages that this machine lacks are fetched.
    local apt=(apt-get -o "Dir::State::lists=$work/apt/lists" -o "Dir::Cache=$work/apt/cache"
        -o Debug::NoLocking=true -o APT::Sandbox::User=root)
    say "Downloading the driver and its libraries into $user_driver"
    "${apt[@]}" -qq update </dev/null >&2 || fail "apt-get update failed: is there a network?"
    # shellcheck disable=SC2046 # lists of package names
    "${apt[@]}" -y --no-install-recommends --download-only --reinstall install \
        mesa-vulkan-drivers $(missing_packages libvulkan1 $(packages_for window)) </dev/null >&2 ||
        fail "the download failed"
    for archive in "$work"/apt/cache/archives/*.deb; do
        name=${archive##*/}
        case $name in
            # A second C library beside the system's own can't work.
            libc6_*) fail "the driver needs a newer C library than this system has: ask the administrator for it" ;;
        esac
        dpkg-deb -x "$archive" "$work"
    done
    rm -rf "$work/apt"
    rm -rf "$user_driver"
    mv "$work" "$user_driver"

    for part in "$user_driver"/lib/*-linux-gnu "$user_driver"/usr/lib/*-linux-gnu; do
        if [ -d "$part" ]; then folders="$folders${folders:+:}$part"; fi
    done
    # The manifests name their library by its place in the system: name it by its place here,
    # relative to the manifest.
    for manifest in "$user_driver"/usr/share/vulkan/icd.d/*.json; do
        [[ $(<"$manifest") =~ $field ]] || continue
        name=${BASH_REMATCH[1]##*/}
        for library in "$user_driver"/usr/lib/*-linux-gnu/"$name"; do
            if [ -e "$library" ]; then
                sed -i "s#\"library_path\".*\"#\"library_path\": \"../../../${library#"$user_driver"/usr/}\"#" "$manifest"
                drivers="$drivers${drivers:+:}$manifest"
            fi
        done
    done
    write_environment "$folders" "$drivers" >"$user_driver/env"

    if LD_LIBRARY_PATH="$folders${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" \
        ldd "$user_driver"/usr/lib/*-linux-gnu/libvulkan_lvp.so | grep 'not found' >&2; then
        fail "the software driver lacks the libraries above"
    fi
    say "Done. ./x uses this driver by itself where the system has none."
    say "For the program alone, first run:  . '$user_driver/env'"
    say "To remove it:  rm -r '$user_driver'"
}

# Prints those of the given Debian packages that are not installed.
missing_packages() {
    local name
    for name in "$@"; do
        if [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" != installed ]; then
            printf '%s\n' "$name"
        fi
    done
}

# Prints the settings for the driver in the home, to be read by any shell.
write_environment() {
    local quote="'\\''"
    # shellcheck disable=SC2016 # the shell that reads the file expands it
    printf "export LD_LIBRARY_PATH='%s'%s\n" "${1//\'/$quote}" '"${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"'
    # The loader knows the first name since 1.3.207 and the second before that.
    printf "export VK_DRIVER_FILES='%s' VK_ICD_FILENAMES='%s'\n" "${2//\'/$quote}" "${2//\'/$quote}"
    if [ -d "$user_driver/usr/share/X11/xkb" ]; then
        printf "export XKB_CONFIG_ROOT='%s'\n" "${user_driver//\'/$quote}/usr/share/X11/xkb"
    fi
    if [ -d "$user_driver/usr/share/X11/locale" ]; then
        printf "export XLOCALEDIR='%s'\n" "${user_driver//\'/$quote}/usr/share/X11/locale"
    fi
}
