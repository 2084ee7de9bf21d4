# What bash offers for the last of the words of a command line: complete.bash SCRIPT vehd run --res
source "$1"
shift
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
_vehd
echo "${COMPREPLY[*]}"
