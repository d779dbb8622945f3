#!/bin/sh
# in_a_browser.sh MAKE_PAGE APP: checks the types of the page's program and clicks through made pages in Chromium (CHROMIUM, or Debian's).
# APP is the folder where the page was bundled, with its node_modules. Exit status 77 where something is missing.
set -eu
make_page=$1
app=$2
here=$(cd "$(dirname "$0")" && pwd)
chromium=${CHROMIUM:-/usr/bin/chromium}

skip() {
  echo "skipped: $*"
  exit 77
}
command -v node >/dev/null || skip "there is no node (Debian package nodejs)"
[ -x "$chromium" ] || skip "there is no $chromium (Debian package chromium)"
[ -d "$app/node_modules/playwright-core" ] || skip "the page's libraries for tests are not in $app/node_modules"

pages=$(mktemp -d)
trap 'rm -rf "$pages"' EXIT
"$make_page" "$pages" || exit $?
(cd "$app" && node_modules/.bin/tsc --noEmit)
node "$here/in_a_browser.mjs" "$app" "$chromium" "$pages"
