// node number_texts_test.mjs REFERENCE_PROGRAM WEB_PROGRAM NODE WORK_FOLDER
// Numbers are written and read alike in WebAssembly and natively. Status 77: the program for browsers is absent.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {skipWithout} from './needs.mjs';

const [reference, program, node, work] = process.argv.slice(2);
skipWithout([program, 'build the preset `web`']);
execFileSync(reference, [`${work}/numbers.native`], {stdio: 'inherit'});
execFileSync(node, [program, `${work}/numbers.web`], {stdio: 'inherit'});
const [natively, web] = ['native', 'web'].map((name) => readFileSync(`${work}/numbers.${name}`, 'utf8').split('\n'));
assert.ok(natively.length > 100000);
assert.equal(web.length, natively.length);
web.forEach((line, i) => assert.equal(line, natively[i]));
console.log(`ok   ${web.length} lines are equal`);
