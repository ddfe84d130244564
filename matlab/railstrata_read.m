function result = railstrata_read(folder)
%RAILSTRATA_READ  A result folder of RailStrata as a struct. For MATLAB (R2016b or newer) and GNU Octave (7 or newer).
%
%   r = railstrata_read('results/quick')
%
%   r.folder, r.title
%   r.summary      summary.json; the names of its numbers end in their units: r.summary.contact.p_max_Pa
%   r.patch        patch.csv: a matrix for each column, rows along x (stations), columns along y.
%                  contourf(r.patch.x_mm, r.patch.y_mm, r.patch.p_MPa). Of a wheel that touches at several places an
%                  array of structs
%   r.history, r.centre_line, r.depth_line, r.streamlines, ...
%                  the other tables of the folder, each a struct of columns. [] for one that the folder lacks
%   r.sections     stresses in planes: rail_cross_section, wheel_longitudinal_section, ... as matrices, rows along depth,
%                  columns along x or y
%
%   Every struct of a table has .units: r.patch.units.p_MPa is 'MPa', '' where a column has no unit. Axes: x in the
%   rolling direction, y towards the field side, depth into the body; tractions act on the rail.
  if exist(fullfile(folder, 'summary.json'), 'file') ~= 2
    error('railstrata:no_result', '%s is no result folder of RailStrata: it has no summary.json', folder);
  end
  result.folder = folder;
  result.summary = jsondecode(fileread(fullfile(folder, 'summary.json')));
  result.title = '';
  if isfield(result.summary, 'title')
    result.title = result.summary.title;
  end
  for name = {'history', 'centre_line', 'depth_line', 'streamlines'}
    result.(name{1}) = [];
  end
  result.patch = [];
  result.sections = struct();
  files = dir(fullfile(folder, '*.csv'));
  for k = 1:numel(files)
    name = strrep(files(k).name, '.csv', '');
    table = read_table(fullfile(folder, files(k).name));
    if strcmp(name, 'patch')
      result.patch = patches_of(table);
    elseif ~isempty(strfind(name, '_section'))
      result.sections.(name) = as_matrices(table, 'depth_mm');
    else
      result.(matlab.lang.makeValidName(name)) = table;
    end
  end
end

% Columns of a table by their names, numbers as column vectors, texts as cells.
function table = read_table(file)
  lines = strsplit(strtrim(strrep(fileread(file), sprintf('\r'), '')), sprintf('\n'));
  lines = lines(~strncmp(lines, '#', 1));
  names = strsplit(lines{1}, ',');
  rows = numel(lines) - 1;
  cells = cell(rows, numel(names));
  for i = 1:rows
    cells(i, :) = strsplit(lines{i + 1}, ',', 'CollapseDelimiters', false);
  end
  table.units = struct();
  for j = 1:numel(names)
    name = regexprep(names{j}, '^(state)_.*$', '$1');
    values = str2double(cells(:, j));
    text = isnan(values) & ~cellfun(@isempty, cells(:, j)) & ~strcmpi(cells(:, j), 'nan');
    if any(text)
      table.(name) = cells(:, j);
    else
      table.(name) = values;
    end
    table.units.(name) = unit_of(name);
  end
end

function unit = unit_of(name)
  known = {'J_per_m2', 'J_per_m', 'mm_s', 'mm2', 'm_s', 'N_m', 'per_m', 'mm', 'MPa', 'kN', 'nm', 'um', 'rad', 'Pa', ...
           'ms', 'kg', 'J', 'W', 'N', 'K', 's', 'm'};
  written = {'J/m^2', 'J/m', 'mm/s', 'mm^2', 'm/s', 'N m', '1/m', 'mm', 'MPa', 'kN', 'nm', 'um', 'rad', 'Pa', ...
             'ms', 'kg', 'J', 'W', 'N', 'K', 's', 'm'};
  unit = '';
  for k = 1:numel(known)
    ending = ['_', known{k}];
    if numel(name) > numel(ending) && strcmp(name(end - numel(ending) + 1:end), ending)
      unit = written{k};
      return
    end
  end
end

% Matrices of patch.csv, a struct for each patch: the table of several patches has their numbers in a column.
function patches = patches_of(table)
  number = ones(size(table.x_mm));
  if isfield(table, 'patch')
    number = table.patch;
  end
  patches = [];
  for k = unique(number).'
    one = table;
    for name = fieldnames(rmfield(table, 'units')).'
      one.(name{1}) = table.(name{1})(number == k);
    end
    patches = [patches, as_matrices(one, 'x_mm')];
  end
end

% The numbers of a table as matrices: a row of the matrix for each run of equal values of `key`.
function table = as_matrices(table, key)
  values = table.(key);
  per_run = find([values(2:end) ~= values(1:end - 1); true], 1);
  names = fieldnames(table);
  if mod(numel(values), per_run) ~= 0
    return
  end
  for k = 1:numel(names)
    column = table.(names{k});
    if isnumeric(column) && numel(column) == numel(values)
      table.(names{k}) = reshape(column, per_run, []).';
    end
  end
end
