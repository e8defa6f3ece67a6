# Looks for what Lightbench needs on this machine. Changes nothing; read by ../x.
# shellcheck shell=bash disable=SC2154 # root, home, system and the like are set there

# The libraries that the window opens at run time. Nothing is linked against them.
window_libraries=(libX11.so.6 libX11-xcb.so.1 libXcursor.so.1 libXi.so.6 libxkbcommon.so.0
    libxkbcommon-x11.so.0 libwayland-client.so.0)

# Prints the names of the shared libraries in the loader's cache that fit this machine.
list_libraries() {
    local ldconfig tag=
    ldconfig=$(command -v ldconfig || true)
    # An ordinary user's PATH on Debian has no /sbin.
    if [ -z "$ldconfig" ] && [ -x /sbin/ldconfig ]; then ldconfig=/sbin/ldconfig; fi
    if [ -z "$ldconfig" ]; then return; fi
    case $machine in
        x86_64) tag='x86-64' ;;
        aarch64) tag='AArch64' ;;
    esac
    "$ldconfig" -p 2>/dev/null | grep -F -- "$tag" || true
}
libraries=

have_library() {
    local IFS=: directory
    for directory in ${LD_LIBRARY_PATH:-}; do
        if [ -n "$directory" ] && [ -e "$directory/$1" ]; then return 0; fi
    done
    # A system without a cache (NixOS, musl) can't be asked. The program itself will tell.
    if [ -z "$libraries" ]; then return 0; fi
    case $libraries in *$'\t'"$1 ("*) return 0 ;; esac
    return 1
}

# Prints the Vulkan driver manifests that the loader would read, one a line (Khronos, "Loader and
# Driver Interface", section "Driver Discovery").
list_manifests() {
    local IFS=: entry file forced=${VK_DRIVER_FILES:-${VK_ICD_FILENAMES:-}}
    if [ -n "$forced" ]; then
        for entry in $forced; do
            if [ -d "$entry" ]; then printf '%s\n' "$entry"/*.json; else printf '%s\n' "$entry"; fi
        done
        return
    fi
    for entry in "${XDG_CONFIG_HOME:-$home/.config}" ${XDG_CONFIG_DIRS:-/etc/xdg} /etc \
        "${XDG_DATA_HOME:-$home/.local/share}" ${XDG_DATA_DIRS:-/usr/local/share:/usr/share}; do
        for file in "$entry"/vulkan/icd.d/*.json; do printf '%s\n' "$file"; done
    done
}

# Prints the manifests whose name matches the pattern and whose library is really there.
usable_manifests() {
    local pattern=$1 file library
    local field='"library_path"[[:space:]]*:[[:space:]]*"([^"]+)"'
    list_manifests | while read -r file; do
        # shellcheck disable=SC2254 # the pattern is meant to match as one
        case ${file##*/} in
            *.i[3-6]86.json) continue ;;
            $pattern) ;;
            *) continue ;;
        esac
        if [ ! -r "$file" ] || ! [[ $(<"$file") =~ $field ]]; then continue; fi
        library=${BASH_REMATCH[1]}
        case $library in
            /*) [ -e "$library" ] || continue ;;
            */*) [ -e "${file%/*}/$library" ] || continue ;;
            *) have_library "$library" || continue ;;
        esac
        printf '%s\n' "$file"
    done
}

has_display() {
    if [ "$system" = Darwin ]; then [ "${CI:-}" != true ]; else [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; fi
}

has_terminal() { [ "${CI:-}" != true ] && [ -t 0 ] && [ -t 2 ]; }

# Each check prints nothing where all is well, else one line that says what is missing.

check_rust() {
    local wanted found
    wanted=$(sed -n 's/^rust-version *= *"\(.*\)"/\1/p' "$root/Cargo.toml")
    if ! command -v rustc >/dev/null || ! command -v cargo >/dev/null; then
        printf 'Rust %s or newer (no rustc and cargo in PATH)\n' "$wanted"
        return
    fi
    if ! found=$(rustc --version 2>/dev/null); then
        printf 'Rust %s or newer (rustc --version fails)\n' "$wanted"
        return
    fi
    found=${found#rustc }
    found=${found%%[ -]*}
    if ! at_least "$found" "$wanted"; then
        printf 'Rust %s or newer (found %s)\n' "$wanted" "$found"
    fi
}

# Compares the major and minor numbers of two versions.
at_least() {
    local have=${1#*.} want=${2#*.}
    [ "${1%%.*}" -gt "${2%%.*}" ] || {
        [ "${1%%.*}" -eq "${2%%.*}" ] && [ "${have%%.*}" -ge "${want%%.*}" ]
    }
}

check_compiler() {
    if ! command -v cc >/dev/null; then
        printf 'a C compiler, which Rust links with (no cc in PATH)\n'
    elif [ "$system" = Linux ] && [ ! -e "$(cc -print-file-name=crt1.o 2>/dev/null)" ]; then
        printf "the C library's development files (cc finds no crt1.o)\n"
    fi
}

# check_driver any|software
check_driver() {
    local pattern='*.json' kind='a Vulkan driver'
    if [ "$system" != Linux ]; then return; fi
    if [ "$1" = software ] && [ -z "$chosen_driver" ]; then
        pattern='lvp_icd*.json' kind="Mesa's software Vulkan driver"
    fi
    if ! have_library libvulkan.so.1; then
        printf 'the Vulkan loader (no libvulkan.so.1)\n'
    fi
    if [ -z "$(usable_manifests "$pattern")" ]; then
        if [ -n "$chosen_driver" ]; then
            printf 'a Vulkan driver where VK_DRIVER_FILES says (%s)\n' "$chosen_driver"
        else
            printf '%s (no such file as /usr/share/vulkan/icd.d/%s)\n' "$kind" "$pattern"
        fi
    fi
}

check_window() {
    local library absent=
    if [ "$system" != Linux ] || ! has_display; then return; fi
    for library in "${window_libraries[@]}"; do
        have_library "$library" || absent="$absent $library"
    done
    if [ -n "$absent" ]; then printf 'libraries for the window (no%s)\n' "$absent"; fi
}

# A display of its own for the tests that work in a real window.
check_screen() {
    local library absent=
    if [ "$system" != Linux ]; then return; fi
    for library in "${window_libraries[@]}"; do
        case $library in *wayland*) continue ;; esac
        have_library "$library" || absent="$absent $library"
    done
    if ! command -v Xvfb >/dev/null; then absent="$absent Xvfb"; fi
    if [ -n "$absent" ]; then printf 'a virtual display for the tests (no%s)\n' "$absent"; fi
}

# Uses the driver in the user's home where the system lacks one.
adopt_user_driver() {
    if [ -z "$chosen_driver" ] && [ -r "$user_driver/env" ] && [ -n "$(check_driver "$1")$(check_window)" ]; then
        # shellcheck source=/dev/null
        . "$user_driver/env"
    fi
}
