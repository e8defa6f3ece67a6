# Installs what Lightbench needs, or says how to. Read by ../x, after look.sh.
# shellcheck shell=bash disable=SC2034,SC2154 # some variables are set or used elsewhere

# Prints the name of the system's package manager, or nothing.
package_manager() {
    local name
    for name in apt-get dnf pacman zypper; do
        if command -v "$name" >/dev/null; then
            printf '%s\n' "$name"
            return
        fi
    done
}

# packages_for GROUP: prints the system's names for a group of packages.
packages_for() {
    case $1:$(package_manager) in
        compiler:apt-get) echo gcc libc6-dev ;;
        compiler:pacman) echo gcc ;;
        compiler:*) echo gcc glibc-devel ;;
        driver:apt-get) echo mesa-vulkan-drivers libvulkan1 ;;
        driver:dnf) echo mesa-vulkan-drivers vulkan-loader ;;
        driver:pacman) echo vulkan-swrast vulkan-icd-loader ;;
        driver:zypper) echo libvulkan_lvp libvulkan1 ;;
        window:apt-get)
            echo libx11-6 libx11-xcb1 libxcursor1 libxi6 libxkbcommon0 libxkbcommon-x11-0 libwayland-client0
            ;;
        window:dnf) echo libX11 libX11-xcb libXcursor libXi libxkbcommon libxkbcommon-x11 libwayland-client ;;
        window:pacman) echo libx11 libxcursor libxi libxkbcommon libxkbcommon-x11 wayland ;;
        window:zypper)
            echo libX11-6 libX11-xcb1 libXcursor1 libXi6 libxkbcommon0 libxkbcommon-x11-0 libwayland-client0
            ;;
        screen:apt-get) echo xvfb libx11-6 libx11-xcb1 libxcursor1 libxi6 libxkbcommon0 libxkbcommon-x11-0 ;;
        screen:dnf) echo xorg-x11-server-Xvfb libX11 libX11-xcb libXcursor libXi libxkbcommon libxkbcommon-x11 ;;
        screen:pacman) echo xorg-server-xvfb libx11 libxcursor libxi libxkbcommon libxkbcommon-x11 ;;
        screen:zypper)
            echo xorg-x11-server-Xvfb libX11-6 libX11-xcb1 libXcursor1 libXi6 libxkbcommon0 libxkbcommon-x11-0
            ;;
    esac
}

# Prints the command that installs the packages, as a person would type it.
install_command() {
    case $(package_manager) in
        apt-get) echo "apt-get install $*" ;;
        dnf) echo "dnf install $*" ;;
        pacman) echo "pacman -S --needed $*" ;;
        zypper) echo "zypper install $*" ;;
    esac
}

# install_packages PREFIX… -- PACKAGE…: the prefix is empty for root, else sudo and its options.
install_packages() {
    local as=() apt
    while [ "$1" != -- ]; do
        as+=("$1")
        shift
    done
    shift
    as+=(env DEBIAN_FRONTEND=noninteractive)
    case $(package_manager) in
        apt-get)
            apt=(apt-get -o DPkg::Lock::Timeout=300)
            # A fresh container has no package lists, and old lists name files that are gone.
            if apt-cache show --no-all-versions "$@" >/dev/null 2>&1 &&
                "${as[@]}" "${apt[@]}" install -y --no-install-recommends "$@"; then
                return 0
            fi
            "${as[@]}" "${apt[@]}" update &&
                "${as[@]}" "${apt[@]}" install -y --no-install-recommends "$@"
            ;;
        dnf) "${as[@]}" dnf install -y "$@" ;;
        pacman) "${as[@]}" pacman -S --needed --noconfirm "$@" ;;
        zypper) "${as[@]}" zypper --non-interactive install --no-recommends "$@" ;;
    esac
}

# Installs packages if that is allowed. Returns 1 where it is not, or where it fails.
try_install() {
    local answer=
    if [ -z "$(package_manager)" ]; then return 1; fi
    if [ "$(id -u)" = 0 ]; then
        say "Installing: $*"
        install_packages -- "$@" </dev/null >&2
    elif ! command -v sudo >/dev/null; then
        return 1
    elif [ "${LIGHTBENCH_SUDO:-}" = yes ]; then
        say "Installing with sudo: $*"
        if has_terminal; then install_packages sudo -- "$@" >&2; else install_packages sudo -n -- "$@" </dev/null >&2; fi
    elif has_terminal; then
        printf 'Run  sudo %s  now? [y/N] ' "$(install_command "$@")" >&2
        read -r answer || true
        case $answer in
            [yY] | [yY][eE][sS]) install_packages sudo -- "$@" >&2 ;;
            *) return 1 ;;
        esac
    else
        return 1
    fi
}

# Prints how to mend what is missing by hand: explain_mending GROUP…
explain_mending() {
    local group packages='' user=no
    for group in "$@"; do
        case $group in
            rust)
                say "Rust: get it from https://rustup.rs, or update it with:  rustup update stable"
                continue
                ;;
            driver | window) user=yes ;;
        esac
        packages="$packages $(packages_for "$group")"
    done
    packages=${packages# }
    if [ "$system" = Darwin ]; then
        case " $* " in *' compiler '*) say "C compiler: xcode-select --install" ;; esac
        return
    fi
    if [ -n "${packages// /}" ]; then
        # shellcheck disable=SC2086 # a list of package names
        say "As root:       $(install_command $packages)"
    elif [ "$*" != rust ]; then
        say "Install Mesa's Vulkan drivers (lavapipe), the Vulkan loader and the libraries named above."
    fi
    if [ "$user" = yes ] && [ "$(package_manager)" = apt-get ]; then
        say "Without root:  ./x setup --user   (the driver and the window libraries, into $user_driver)"
    fi
}

# Sets `missing` (one line each) and `groups` (what to install) for the given needs: rust,
# compiler, driver, software, window, screen.
look() {
    local need line group
    missing=() groups=()
    for need in "$@"; do
        case $need in
            rust) line=$(check_rust) group=rust ;;
            compiler) line=$(check_compiler) group=compiler ;;
            driver) line=$(check_driver any) group=driver ;;
            software) line=$(check_driver software) group=driver ;;
            window) line=$(check_window) group=window ;;
            screen) line=$(check_screen) group=screen ;;
        esac
        if [ -z "$line" ]; then continue; fi
        missing+=("$line")
        case " ${groups[*]-} " in *" $group "*) ;; *) groups+=("$group") ;; esac
    done
}

# Makes sure that everything is there, or ends with the way to get it.
ensure() {
    local packages='' group
    prepare "$@"
    look "$@"
    if [ ${#missing[@]} -eq 0 ]; then return; fi
    say "Missing:"
    printf '%s\n' "${missing[@]}" | sed 's/^/  /' >&2
    for group in "${groups[@]}"; do
        if [ "$group" != rust ]; then packages="$packages $(packages_for "$group")"; fi
    done
    # A driver that VK_DRIVER_FILES hides can't be mended with a package.
    case ${missing[*]} in
        *VK_DRIVER_FILES*) fail "correct VK_DRIVER_FILES, or unset it to use the system's drivers" ;;
    esac
    # shellcheck disable=SC2086 # a list of package names
    if [ -n "${packages// /}" ] && try_install $packages; then
        libraries=$(list_libraries)
        prepare "$@"
        look "$@"
        if [ ${#missing[@]} -eq 0 ]; then return; fi
        say "Still missing:"
        printf '%s\n' "${missing[@]}" | sed 's/^/  /' >&2
    fi
    explain_mending "${groups[@]}"
    exit 1
}

# Points this run at the right driver: the one in the home where the system has none, and the
# software driver for the tests.
prepare() {
    local manifest
    if [ "$system" != Linux ]; then return; fi
    case " $* " in
        *' software '*)
            adopt_user_driver software
            manifest=$(usable_manifests 'lvp_icd*.json' | head -n 1)
            if [ -n "$manifest" ] && [ -z "$chosen_driver" ]; then
                export VK_DRIVER_FILES=$manifest VK_ICD_FILENAMES=$manifest
            fi
            ;;
        *' driver '*) adopt_user_driver any ;;
    esac
}
