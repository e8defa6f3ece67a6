# Holds the documents to what they say: the paths that they name and the README's command. Read by
# ../x.
# shellcheck shell=bash disable=SC2154 # root is set there

# Fails where a document links to a file that is not there, or names a path of this tree that is
# gone. A path to be made by the reader is written with a NAME in capitals. The text of a lesson names
# files of its starter; what new lessons are made from is tried by a test that makes one.
step_links() {
    local broken
    broken=$(
        find "$root" -name '*.md' -not -path "$root/target/*" -not -path "$root/out/*" -not -path '*/template/*' |
            LC_ALL=C sort | while read -r document; do
            {
                # What stands in a block of code is an example.
                awk '/^ *```/ { code = !code; next } !code' "$document" | grep -oE '\]\([^)# ]+' | sed 's/^](//' | grep -vE '^[a-z]+:'
                # shellcheck disable=SC2016 # these are the document's own back quotes
                grep -oE '`(engine|editor|scripts|shaders|lessons|tests)/[a-z0-9_./-]*`' "$document" | tr -d '`'
            } | while read -r path; do
                if [ ! -e "${document%/*}/$path" ] && [ ! -e "${document%/*}/starter/$path" ] &&
                    [ ! -e "$root/$path" ]; then
                    printf '%s: there is no %s\n' "${document#"$root"/}" "$path"
                fi
            done
        done
    )
    if [ -n "$broken" ]; then
        say "$broken"
        return 1
    fi
}

# Prints the README's command for a machine without a display.
readme_command() {
    awk '/^<!-- headless -->/ { found = 1; next }
        found && /^```/ { if (inside) exit; inside = 1; next }
        inside' "$root/README.md"
}

step_readme() {
    local script before
    script=$(readme_command)
    [ -n "$script" ] || { say "README.md has no command after <!-- headless -->"; return 1; }
    before=$(mktemp)
    in_root bash -euo pipefail -c "$script" || return 1
    if [ -z "$(find "$root/out/report" -name '*.html' -newer "$before" -size +0)" ]; then
        say "the command wrote no report into out/report"
        return 1
    fi
    rm -f "$before"
}
